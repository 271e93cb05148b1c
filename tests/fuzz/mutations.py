"""Values and bytes that files of users have held, or may hold."""

from hypothesis import strategies as st

NUMBERS = [
    *("0", "-1", "1e-300", "1e300", "1e400", "-1e9", "1e9", "nan", "inf", "-inf", "NaN", "1e10"),
    *("0.5", "100", "1000", "-0.0", "1e-6", "180", "57.3", "2147483648", "18446744073709551616"),
]
TEXTS = [
    *("", " ", "x", "-", "null", "true", "no", "1,5", "1_000", "0x10", "1e", "#N/A", "1.2.3", "١٢"),
    *("=1+1", "'1'", '"1"', "2020-99-99", "12:30", "$5$", "[/x]", "<b>", "../up", "a/b", "\x1b[31m"),
    *("\ufeff", "x" * 300, "é", "\u2028", "None", "1 2", "9" * 400, "self", "{}", "[]"),
]
YAML_VALUES = [
    *(
        "~",
        "yes",
        "[]",
        "{}",
        "[1, 2]",
        "{a: 1}",
        "{1: 2}",
        "{self: 1}",
        ".nan",
        ".inf",
        "-.inf",
        "1e400",
    ),
    *("!!timestamp 2020-99-99", '!!int ""', '!!bool "x"', '!!float ""', "!!binary x", "!!python/none x"),
    *("&a [*a]", "*a", "&b 1", "'../up'", "'a/b'", '"\\0"', '"\\e[31m"', "'[/x]'", "'$\\foo$'", "''"),
    *("2020-99-99", "0b_", "0x_", "._", "1:99:99", "|", ">", "? x", "- x", "!x y", "@", "`", "%"),
    *("[" * 200, "{a: " * 50, "<<", "{<<: {a: 1}}", "'\ud7ff'", "\x85", "1__0", "=", "9" * 5000),
    *("1e9", "1e-9", "1e300", "-1", "0", "true", "1000", "0.001", "viscous-plastisol", "nitinol-0.59"),
]
PLAUSIBLE = ["0", "1e-6", "1e-4", "0.001", "0.01", "0.05", "0.1", "0.5", "1", "2", "3", "10", "45", "90"]
plausible = st.sampled_from([*PLAUSIBLE, "200", "1000", "-1", "-0.1", "-90"])
numbers = st.sampled_from(NUMBERS) | st.floats(width=64).map(repr) | st.integers().map(str)
cells = numbers | st.sampled_from(TEXTS) | st.text(max_size=8)
yaml_values = numbers | st.sampled_from(YAML_VALUES) | st.text(max_size=8)


@st.composite
def changed_bytes(draw, data, most=4):
    """Bytes with some flipped, cut out, put in, doubled or cut off."""
    changed = bytearray(data)
    for _ in range(draw(st.integers(1, most))):
        at = draw(st.integers(0, max(len(changed) - 1, 0)))
        until = at + draw(st.sampled_from([1, 2, 8, 64, 1024]))
        match draw(st.sampled_from(["flip", "cut", "put", "double", "end", "zero"])):
            case "flip" if changed:
                changed[at] ^= 1 << draw(st.integers(0, 7))
            case "cut":
                del changed[at:until]
            case "put":
                changed[at:at] = draw(st.binary(max_size=16))
            case "double":
                changed[at:at] = changed[at:until]
            case "end":
                del changed[at:]
            case "zero":
                changed[at:until] = b"\0" * len(changed[at:until])
    return bytes(changed)


@st.composite
def changed_lines(draw, text, values):
    """Text of lines, of which some have another value behind a colon, or other places."""
    lines = text.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        i = draw(st.integers(0, max(len(lines) - 1, 0)))
        if not lines:
            break
        name, colon, _ = lines[i].partition(":")
        match draw(
            st.sampled_from(["value", "value", "value", "name", "drop", "double", "line", "indent"])
        ):
            case "value" if colon:
                lines[i] = f"{name}: {draw(values)}"
            case "name" if colon:
                indent = lines[i][: len(lines[i]) - len(lines[i].lstrip(" -"))]
                lines[i] = f"{indent}{draw(values)}:{lines[i].partition(':')[2]}"
            case "drop":
                del lines[i]
            case "double":
                lines.insert(i, lines[i])
            case "line":
                lines.insert(i, draw(values))
            case "indent":
                lines[i] = "  " + lines[i]
    return "\n".join(lines) + "\n"
