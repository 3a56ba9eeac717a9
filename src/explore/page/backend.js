// Where the page asks: the server that it comes from. A page without a server has another file in this place.

export const ask = (path, options = undefined) => fetch(path, options);

// The page is being closed: an answer cannot be waited for.
export const leave = (page) => navigator.sendBeacon("leave", page);
