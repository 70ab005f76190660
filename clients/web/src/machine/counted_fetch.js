// @ts-check
// Counts the bytes received by fetch(), also those of the files that Pyodide fetches itself.

/** Calls `onBytes` with the number of bytes that fetch() has received since this call. @param {(bytes: number) => void} onBytes */
export function countFetched(onBytes) {
  const real = self.fetch;
  let bytes = 0;
  const add = (/** @type {number} */ more) => onBytes((bytes += more));
  self.fetch = async (...request) => counted(await real(...request), add);
}

/** A response with the same contents; `add` is called with the size of each part received. @param {Response} response @param {(bytes: number) => void} add */
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
