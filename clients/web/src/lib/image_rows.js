// The rows of `image` messages: run lengths, zeros first, as in the encoding `rle`. Independent of the page.

/** The lengths of the runs of a row of 0 and 1, zeros first. */
export function runsOf(row) {
  const runs = row.match(/0+|1+/g)?.map(({ length }) => length) ?? [];
  return row.startsWith("1") ? [0, ...runs] : runs;
}

/** The image with run lengths, whatever its encoding. */
export const withRuns = (image) => (image.encoding === "rows" ? { ...image, encoding: "rle", rows: image.rows.map(runsOf) } : image);
