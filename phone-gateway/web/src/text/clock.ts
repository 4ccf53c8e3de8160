/** @param seconds  whole. @return "4:07". */
export function clockInWords(seconds: number): string {
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}
