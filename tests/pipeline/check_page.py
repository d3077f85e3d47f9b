"""Check a page of `swimtwin report`: every element closed, nothing from the network, pictures whole. Prints their number.

    check_page.py report.html
"""
import base64
import sys
from html.parser import HTMLParser

EMPTY = {"meta", "img", "br", "hr", "link", "input"}


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.pictures = [], []

    def handle_starttag(self, tag, attributes):
        if tag in ("script", "link", "iframe", "object"):
            sys.exit(f"<{tag}> in line {self.getpos()[0]}")
        if tag not in EMPTY:
            self.open.append(tag)
        attributes = dict(attributes)
        if "://" in (attributes.get("href") or ""):
            sys.exit(f"the link {attributes['href']} leads to the network")
        if tag == "img":
            self.pictures.append(attributes)

    def handle_endtag(self, tag):
        if tag not in EMPTY and (not self.open or self.open.pop() != tag):
            sys.exit(f"</{tag}> in line {self.getpos()[0]} closes another element")


with open(sys.argv[1], encoding="utf-8") as file:
    page = Page()
    page.feed(file.read())
    page.close()
if page.open:
    sys.exit(f"not closed: {page.open}")
for picture in page.pictures:
    scheme, data = picture["src"].split(",", 1)
    png = base64.b64decode(data, validate=True)
    if scheme != "data:image/png;base64" or png[:8] != b"\x89PNG\r\n\x1a\n" or b"IEND" not in png[-12:]:
        sys.exit(f"{picture['alt']} is no whole PNG")
print(len(page.pictures))
