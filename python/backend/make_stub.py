"""Writes the types of the package: the template with all options of solve(), as the module itself tells them.

Usage: make_stub.py TEMPLATE OUTPUT, with the package in PYTHONPATH.
"""

import sys

import penumbra


def type_of(option):
    if option["kind"] == "str":
        return f"Literal[{', '.join(repr(choice) for choice in option['choices'])}] | None"
    return f"{option['kind']} | None"


def options_text(indent):
    """A line for each option; those without a default of their own are None."""
    return "\n".join(f"{indent}{name}: {type_of(option)} = {option['default']!r},"
                     for name, option in penumbra.options().items())


def main(template_path, output_path):
    with open(template_path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    filled = [options_text(line[:line.index("@OPTIONS@")]) if "@OPTIONS@" in line else line for line in lines]
    with open(output_path, "w", encoding="utf-8") as file:
        file.write("\n".join(filled))


if __name__ == "__main__":
    main(*sys.argv[1:])
