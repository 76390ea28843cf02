"""What holds for every page that hdem makes."""
import html.parser
import re
import xml.etree.ElementTree

VOID = {"meta", "br", "link", "img"}


class Nesting(html.parser.HTMLParser):
    """Every element is closed, in the order in which it was opened, and ids are unique."""

    def __init__(self):
        super().__init__()
        self.open, self.problems, self.ids = [], [], []

    def handle_starttag(self, tag, attributes):
        self.ids += [value for name, value in attributes if name == "id"]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.ids += [value for name, value in attributes if name == "id"]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"</{tag}> at {self.getpos()}")


def asks_for_nothing(test, page):
    """No address but places in the page, and pictures that are part of it."""
    targets = re.findall(r"""(?:src|href|srcset|action|data)\s*=\s*["']([^"']*)""", page)
    test.assertTrue(targets)
    test.assertEqual([target[:80] for target in targets if not target.startswith(("#", "data:image/"))], [])
    test.assertNotRegex(page, r"@import|url\((?!#)|<script|<link|<iframe")


def links_lead_somewhere(test, page):
    nesting = Nesting()
    nesting.feed(page)
    test.assertEqual((nesting.problems, nesting.open), ([], []))
    test.assertEqual(len(nesting.ids), len(set(nesting.ids)))
    test.assertLessEqual(set(re.findall(r'href="#([^"]+)"', page)), set(nesting.ids))


def curves_of(test, page):
    """Those of matplotlib, well-formed like all other pictures, in the page's colours."""
    pictures = re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)
    for picture in pictures:
        xml.etree.ElementTree.fromstring(picture)
    curves = [picture for picture in pictures if 'class="curves"' in picture]
    for picture in curves:
        test.assertNotRegex(picture, "#0102|#0103", "a placeholder of a colour is left")
        test.assertIn("var(--c0)", picture)
    return curves
