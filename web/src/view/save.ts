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
  const records = "captureStream" in HTMLCanvasElement.prototype && filmType() !== undefined;
  if (!records) return "This browser records no WebM films; Firefox, Chrome and Edge do.";
  return "";
}

const PICTURES_PER_SECOND = 25, SECONDS_PER_STATE = 0.5;

/** Records `count` pictures of one size, half a second each; recording waits while `make` makes one. */
export async function recordFilm(count: number, make: (index: number) => Promise<HTMLCanvasElement>): Promise<Blob> {
  const film = document.createElement("canvas");
  const context = film.getContext("2d")!;
  const first = await make(0);
  film.width = first.width;
  film.height = first.height;
  context.drawImage(first, 0, 0);
  const stream = film.captureStream(PICTURES_PER_SECOND);
  const recorder = new MediaRecorder(stream, { mimeType: filmType()!, videoBitsPerSecond: 12e6 });
  const parts: Blob[] = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  try {
    for (let k = 0; k < count; ++k) {
      const picture = k === 0 ? first : await make(k);
      if (k === 0) recorder.start();
      else recorder.resume();
      const seconds = k === count - 1 ? 2 * SECONDS_PER_STATE : SECONDS_PER_STATE;
      // A stream carries a picture whenever the canvas was drawn upon.
      for (let n = 0; n < seconds * PICTURES_PER_SECOND; ++n) {
        context.drawImage(picture, 0, 0);
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
