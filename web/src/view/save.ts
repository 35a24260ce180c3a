// SPDX-License-Identifier: BSD-3-Clause
// Pictures and films as files on the reader's disk; nothing leaves the browser.

export function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

export async function savePicture(canvas: HTMLCanvasElement, name: string): Promise<void> {
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("the browser made no picture; the view may be too large for it");
  save(blob, name);
}

const FILM_TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

function filmType(): string | undefined {
  if (typeof MediaRecorder === "undefined") return undefined;
  return FILM_TYPES.find((type) => MediaRecorder.isTypeSupported(type));
}

/** Why this browser makes no film; empty when it does. */
export function whyNoFilm(states: number): string {
  if (states < 2) return "A film needs more than one stored state.";
  if (!("captureStream" in HTMLCanvasElement.prototype) || filmType() === undefined) return "This browser records no WebM films; Firefox, Chrome and Edge do.";
  return "";
}

const PICTURES_PER_SECOND = 25, SECONDS_PER_STATE = 0.5;

/** Records `count` pictures that `paint` brings onto the canvas, half a second each; recording waits while one is made. */
export async function recordFilm(canvas: HTMLCanvasElement, count: number, paint: (index: number) => Promise<void>): Promise<Blob> {
  const stream = canvas.captureStream(PICTURES_PER_SECOND);
  const recorder = new MediaRecorder(stream, { mimeType: filmType()!, videoBitsPerSecond: 12e6 });
  const parts: Blob[] = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  const context = canvas.getContext("2d")!;
  try {
    for (let k = 0; k < count; ++k) {
      await paint(k);
      if (k === 0) recorder.start();
      else recorder.resume();
      const seconds = k === count - 1 ? 2 * SECONDS_PER_STATE : SECONDS_PER_STATE;
      const until = performance.now() + 1000 * seconds;
      // A stream carries a picture when the canvas was drawn upon: the last pixel is drawn onto itself.
      while (performance.now() < until) {
        context.drawImage(canvas, 0, 0, 1, 1, 0, 0, 1, 1);
        await new Promise((resolve) => setTimeout(resolve, 1000 / PICTURES_PER_SECOND));
      }
      if (k < count - 1) recorder.pause();
    }
    const ended = new Promise((resolve) => recorder.addEventListener("stop", resolve, { once: true }));
    recorder.stop();
    await ended;
  } finally {
    for (const track of stream.getTracks()) track.stop();
  }
  return new Blob(parts, { type: "video/webm" });
}
