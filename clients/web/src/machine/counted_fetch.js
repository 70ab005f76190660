// @ts-check
// Counts the bytes that come by fetch(), as those of the files that Pyodide fetches by itself.

/** From now on `onBytes` is called with the number of bytes that have come. @param {(bytes: number) => void} onBytes */
export function countFetched(onBytes) {
  const real = self.fetch;
  let bytes = 0;
  const add = (/** @type {number} */ more) => onBytes((bytes += more));
  self.fetch = async (...request) => counted(await real(...request), add);
}

/** The same response, which tells how many bytes come. @param {Response} response @param {(bytes: number) => void} add */
function counted(response, add) {
  if (!response.body) return response;
  const counter = new TransformStream({
    transform(chunk, controller) {
      add(chunk.length);
      controller.enqueue(chunk);
    },
  });
  const { status, statusText, headers } = response;
  return new Response(response.body.pipeThrough(counter), { status, statusText, headers });
}
