/** Icons that several screens use, drawn with lines in a 24x24 box. */
export const kStopIcon = "M8 3h8l5 5v8l-5 5H8l-5-5V8z";
export const kCloseIcon = "M6 6l12 12M18 6L6 18";
export const kPlayIcon = "M8 5l11 7-11 7z";
export const kAddIcon = "M12 5v14M5 12h14";
export const kLessIcon = "M5 12h14";
export const kSaveIcon = "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6";
export const kListIcon = "M9 6h11M9 12h11M9 18h11M4.5 6h.01M4.5 12h.01M4.5 18h.01";
export const kEditIcon = "M4 20l1-4L16 5l3 3L8 19zM14 7l3 3";
export const kDownloadIcon = "M12 4v11m-5-5l5 5 5-5M5 20h14";
export const kUploadIcon = "M12 15V4m-5 5l5-5 5 5M5 20h14";
export const kDeleteIcon = "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13";
export const kUpIcon = "M6 15l6-6 6 6";
export const kDownIcon = "M6 9l6 6 6-6";
export const kMirrorIcon = "M12 4v16M9 8l-5 8h5zM15 8l5 8h-5z";
export const kUndoIcon = "M9 6L4 11l5 5M4 11h10a5 5 0 0 1 0 10h-3";
export const kMenuIcon = "M4 7h16M4 12h16M4 17h16";
export const kMoreIcon = "M5 5h5v5H5zM14 5h5v5h-5zM5 14h5v5H5zM14 14h5v5h-5z";
/** An arm with its joints. */
export const kJointsIcon = "M6 19a2 2 0 1 0 0-4 2 2 0 0 0 0 4zM14 10a2 2 0 1 0 0-4 2 2 0 0 0 0 4zM7.4 15.5l5.2-6M16 8l4 4";
/** Four ways. */
export const kWalkIcon = "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3";
export const kSpeechIcon = "M4 5h16v11H11l-5 4v-4H4zM8 9h8M8 12.5h5";
