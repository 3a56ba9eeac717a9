// Sends requests to the server of the page. For the page without a server, `web/build` replaces this file.

export const ask = (path, options = undefined) => fetch(path, options);

// Words after the time of a computation, and for one that has no answer.
export const PLACE = "";
export const LOST = "The program does not answer any more. Save the scene, or start the program again at this address: the page then goes on, and reads what was typed.";

// Reports that the page is being closed. A beacon is sent, because a closing page cannot wait for an answer.
export const leave = (page) => navigator.sendBeacon("leave", page);
