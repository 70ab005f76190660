// @ts-check
// A dialog that asks something: its form has a button with the value `ok`, and one without a value.

/**
 * Resolves to true once it is answered by `ok` and `take` accepts the answer, which else shows what is wrong with it; to false if it is closed.
 * @param {HTMLDialogElement} dialog @param {() => boolean} take
 * @returns {Promise<boolean>}
 */
export function ask(dialog, take = () => true) {
  dialog.returnValue = "";
  dialog.querySelector("form").onsubmit = (event) => {
    const isOk = /** @type {HTMLButtonElement} */ (event.submitter)?.value === "ok";
    if (isOk && !take()) event.preventDefault();
  };
  dialog.showModal();
  return new Promise((resolve) => (dialog.onclose = () => resolve(dialog.returnValue === "ok")));
}
