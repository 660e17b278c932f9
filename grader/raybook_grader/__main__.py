"""`python -m raybook_grader` is `raybook-grader`."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
