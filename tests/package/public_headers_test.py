"""The public headers include no others of the project.

usage: public_headers_test.py SOURCE_FOLDER "HEADER;HEADER;..." [unittest's own arguments]
"""

import pathlib
import re
import sys
import tempfile
import unittest

SOURCE, HEADERS = sys.argv[1:3]


def included(header):
    """What a header includes of its own project."""
    return re.findall(r'^\s*#\s*include\s+"([^"]+)"', header.read_text(), re.MULTILINE)


def not_public(source, headers):
    """What public headers include that is not public: pairs of header and included."""
    return [(header, other) for header in headers
            for other in included(pathlib.Path(source) / header) if other not in headers]


class PublicHeaders(unittest.TestCase):
    def test_are_named_once(self):
        headers = HEADERS.split(";")
        self.assertEqual(len(headers), len(set(headers)))

    def test_include_public_headers_only(self):
        headers = HEADERS.split(";")
        self.assertGreater(sum(len(included(pathlib.Path(SOURCE) / header))
                               for header in headers), len(headers))
        self.assertEqual(not_public(SOURCE, headers), [])

    def test_one_that_includes_another_header_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder)
            (source / "a.h").write_text('#include <vector>\n#include "b.h"\n#  include "c.h"  // why\n')
            (source / "b.h").write_text("")
            self.assertEqual(not_public(source, ["a.h", "b.h"]), [("a.h", "c.h")])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
