// @ts-check
// Entry point: waits for the server's `hello`, then runs the page of a cell or the overview of all cells.
import { isOverview } from "./lib/place.js";
import { firstHello } from "./start.js";

const hello = await firstHello;
await (isOverview(location.pathname, hello) ? import("./overview_page.js") : import("./cell_page.js"));
