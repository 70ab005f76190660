// @ts-check
import { block, kSliceMs } from "./yielding.js";

const kPrintsAtOnce = 50;

/**
 * Sends what a program prints to the page. A program that prints faster than the page can show waits.
 * @param {(message: object) => void} post @param {() => void} serve sends what else there is to say
 */
export function printer(post, serve) {
  let prints = 0;
  return (/** @type {string} */ stream, /** @type {string} */ text) => {
    post({ output: { stream, text } });
    if (++prints % kPrintsAtOnce > 0) return;
    serve();
    block(kSliceMs);
  };
}
