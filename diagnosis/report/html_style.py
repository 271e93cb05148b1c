"""How a page looks: on a desk, on a phone, in the dark, on paper."""

STYLE = """
:root{color-scheme:light dark;--text:#1b1b1b;--page:#fff;--line:#c4c4c4;--soft:#f3f4f6;--link:#0b57a4;
--warn:#fff3cd;--warn-line:#a67c00;--muted:#555}
@media (prefers-color-scheme:dark){:root{--text:#e8e8e8;--page:#16181c;--line:#4a4e57;--soft:#22252b;
--link:#8ab8ff;--warn:#3d3200;--warn-line:#d9a800;--muted:#b0b4bc}
img{filter:invert(.91) hue-rotate(180deg)}}
*{box-sizing:border-box}
body{font:1rem/1.55 system-ui,sans-serif;max-width:70rem;margin:0 auto;padding:1rem;
color:var(--text);background:var(--page);overflow-wrap:break-word}
a{color:var(--link)}
:is(a,summary,[tabindex]):focus-visible{outline:3px solid var(--link);outline-offset:2px}
.skip{position:absolute;left:-99rem}.skip:focus{position:static}
.origin{color:var(--muted);font-size:.9rem;margin:0}
h1{font-size:1.45rem;line-height:1.3;margin:.6rem 0}
h2{font-size:1.25rem;margin:2.2rem 0 .6rem;border-bottom:1px solid var(--line);padding-bottom:.2rem}
h3{font-size:1.05rem;margin:1.6rem 0 .4rem}
h1~.lead{font-size:1.1rem;margin:.5rem 0}
nav{background:var(--soft);padding:.6rem 1rem;margin:1.2rem 0;border-radius:.4rem}
nav ul{columns:18rem;margin:.3rem 0;padding-left:1.2rem}
nav a{display:inline-block;padding:.15rem 0}
.scroll{overflow-x:auto;margin:1rem 0;max-width:100%}
figure img{display:block;max-width:100%;height:auto;background:#fff}
table{border-collapse:collapse;font-size:.9rem}
caption{text-align:left;font-weight:600;padding:.2rem 0;white-space:nowrap}
details{border-bottom:1px solid var(--line)}
summary{cursor:pointer;padding:.5rem 0}
details td:last-child{min-width:18rem}
td,th{border-bottom:1px solid var(--line);padding:.3rem .8rem .3rem 0;text-align:left;vertical-align:top}
tbody th{font-weight:inherit}
.warning{background:var(--warn);border-left:.3rem solid var(--warn-line);padding:.5rem 1rem;
margin:.6rem 0}
@media (max-width:48rem){.wide img{max-width:none;width:52rem}nav ul{columns:1}}
@media print{:root{color-scheme:light;--text:#000;--page:#fff;--line:#999;--soft:#fff;--link:#000;
--warn:#fff;--warn-line:#000;--muted:#333}
body{font-size:10pt;max-width:none;padding:0}nav,.skip{display:none}.scroll{overflow:visible}
details::details-content{content-visibility:visible;block-size:auto}
img,.wide img{filter:none;width:auto;max-width:100%;max-height:22cm}
figure,tr,.warning{break-inside:avoid}h1,h2,h3,summary,caption,p:has(+figure){break-after:avoid}}
"""
