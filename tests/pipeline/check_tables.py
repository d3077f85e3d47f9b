"""Read every CSV file below a folder as csv.DictReader alone reads it: check_tables.py FOLDER. Prints the number of files."""
import csv
import pathlib
import sys


def digits(number):
    """Significant digits, and nothing of how they are written."""
    return number.lower().lstrip("+-").split("e")[0].replace(".", "").strip("0")


def problems_of(file):
    with file.open(encoding="utf-8", newline="") as text:
        reader = csv.DictReader(text, strict=True)
        rows = list(reader)
    header = reader.fieldnames
    if len(set(header)) != len(header) or "" in header:
        yield f"names of columns: {header}"
    lines = file.read_text(encoding="utf-8").split("\n")
    if len(lines) != len(rows) + 2 or lines[-1]:
        yield f"{len(lines)} lines for {len(rows)} rows"
    if any(line.startswith("#") or line != line.strip(" \r") for line in lines):
        yield "a comment, or blanks at the end of a line"
    for i, row in enumerate(rows):
        if None in row or None in row.values():
            yield f"row {i + 1} has another number of cells than the header"
        for name, cell in row.items():
            try:
                number = float(cell)
            except (TypeError, ValueError):
                continue
            if digits(cell) != digits(repr(number)):
                yield f"row {i + 1}: {name} = {cell} is not the shortest form of {number!r}"


def main():
    files = sorted(pathlib.Path(sys.argv[1]).rglob("*.csv"))
    found = [f"{file}: {problem}" for file in files for problem in problems_of(file)]
    print("\n".join(found) or len(files))
    return 1 if found else 0


sys.exit(main())
