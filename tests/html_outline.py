"""A page as a screen reader, or a browser without its pictures, finds it."""

from html.parser import HTMLParser

_NEVER_CLOSED = {"meta", "img", "br", "hr", "link", "input"}


class HtmlOutline(HTMLParser):
    """Tags with their attributes, headings, and whether every tag is closed in order.

    Attributes:
      tags: (name, attributes) in the order of the page.
      headings: (level, text).
      unbalanced: tags that are closed out of order.
    """

    def __init__(self, page):
        super().__init__()
        self.tags, self.headings, self.unbalanced = [], [], []
        self._open, self._words = [], None
        self.feed(page)
        self.close()
        self.unbalanced += self._open

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in _NEVER_CLOSED:
            self._open.append(tag)
        if tag in ("h1", "h2", "h3", "h4"):
            self._words = []

    def handle_data(self, data):
        if self._words is not None:
            self._words.append(data)

    def handle_endtag(self, tag):
        if not self._open or self._open.pop() != tag:
            self.unbalanced.append(tag)
        if self._words is not None and tag in ("h1", "h2", "h3", "h4"):
            self.headings.append((int(tag[1]), "".join(self._words)))
            self._words = None

    def attributes(self, tag):
        """Of every tag of a name."""
        return [own for name, own in self.tags if name == tag]

    @property
    def ids(self):
        return [own["id"] for _, own in self.tags if "id" in own]
