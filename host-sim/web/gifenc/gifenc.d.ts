// The part of gifenc that the page uses.

export type Palette = number[][];
type Format = "rgb444" | "rgb565" | "rgba4444";

export function quantize(rgba: Uint8ClampedArray, colors: number, options: { format: Format }): Palette;
export function applyPalette(rgba: Uint8ClampedArray, palette: Palette, format: Format): Uint8Array;
export function GIFEncoder(): {
  /** `delay`: ms */
  writeFrame(index: Uint8Array, width: number, height: number, options: { palette: Palette, delay: number }): void;
  finish(): void;
  bytes(): Uint8Array<ArrayBuffer>;
};
