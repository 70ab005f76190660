// Constants that the build defines (build.mjs).

/** The version of the page, such as "0.10.0". */
declare const XR3_VERSION: string;

/** In the worker of the robot: the bytes of the files that Python is loaded from by fetch(). */
declare const XR3_PYTHON_BYTES: number;

/** In the service worker: the files of the folder, and a version that changes with any of them. */
declare const XR3_FILES: { version: string; names: string[] };
