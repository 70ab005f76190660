// Constants that the build defines (build.mjs).

/** The version of the page, such as "0.7.0". */
declare const XR3_VERSION: string;

/** In the service worker: the files of the folder, and a version that changes with any of them. */
declare const XR3_FILES: { version: string; names: string[] };
