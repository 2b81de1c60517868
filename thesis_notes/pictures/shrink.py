#!/usr/bin/env python3
"""Makes PNG files small enough for the notes: 256 colours each. Usage: shrink.py [--width PIXELS] FILE.png...

Needs Pillow, which comes with python3-matplotlib.
"""

import argparse

from PIL import Image


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--width", type=int, help="make them this wide [pixels], if they are wider")
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    for name in arguments.files:
        image = Image.open(name).convert("RGB")
        if arguments.width and image.width > arguments.width:
            image = image.resize((arguments.width, round(image.height * arguments.width / image.width)), Image.LANCZOS)
        # Pillow spreads the error only over colours that it is given.
        colours = image.quantize(256, Image.Quantize.MEDIANCUT)
        image.quantize(palette=colours, dither=Image.Dither.FLOYDSTEINBERG).save(name, optimize=True)


if __name__ == "__main__":
    main()
