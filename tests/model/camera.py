"""The camera's image of blocks without rotation, from docs/data-files.md: a pixel shows a block if its centre does."""


def image(workcell):
    """The rows of the image from the top, as texts of 0 and 1."""
    camera = workcell["camera"]
    columns, rows = camera["pixels"]
    length, width = camera["field"]
    x, y, _ = camera["location"]
    xs = [x - length / 2 + (column + 0.5) * length / columns for column in range(columns)]
    ys = [y + width / 2 - (row + 0.5) * width / rows for row in range(rows)]
    return ["".join("01"[any(_covers(block, x, y) for block in workcell["blocks"])] for x in xs) for y in ys]


def _covers(block, x, y):
    (length, width, _), (block_x, block_y, _) = block["size"], block["centroid"]
    return abs(x - block_x) < length / 2 and abs(y - block_y) < width / 2
