"""Whether files are well-formed: XML and SVG, HTML, JSON, told by their endings."""

import html.parser
import pathlib
import re
import xml.dom.minidom

from program import load, read

VOID = {"br", "img", "input", "link", "meta"}


class Page(html.parser.HTMLParser):
    """Every tag is closed in its turn, no attribute comes twice, and no "<" or "&" is left in the text."""

    def __init__(self):
        super().__init__(convert_charrefs=False)
        self.open = []

    def handle_starttag(self, tag, attributes):
        names = [name for name, _ in attributes]
        assert len(names) == len(set(names)), f"an attribute twice in <{tag}>"
        assert all(re.fullmatch(r"[a-z][a-z-]*", name) for name in names), f"<{tag}>: attributes {names}"
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, f"</{tag}> closes nothing"

    def handle_data(self, data):
        assert self.open[-1:] in (["script"], ["style"]) or not set(data) & set("<&"), f"a stray < or & in {data!r}"


def well_formed(*names):
    for name in names:
        text = read(name).decode("utf-8")  # strict: no surrogates
        ending = pathlib.Path(name).suffix
        if ending in (".xml", ".svg"):
            xml.dom.minidom.parseString(text.encode("utf-8"))
        elif ending == ".json":
            load(name)
        else:
            stray = re.search("[^\t\n\r -~\u00a0-\ufffd\U00010000-\U0010ffff]", text)
            assert not stray, f"HTML may not hold {stray[0]!r}"
            page = Page()
            page.feed(text)
            page.close()
            assert not page.open, f"not closed: {page.open}"
