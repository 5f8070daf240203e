// Numbers for readers, and back. Angles are radians inside, degrees outside.

const DEGREE = Math.PI / 180;

/** At most so many digits, with a true minus sign. */
export function show(value: number, isAngle = false, digits = 6): string {
    const shown = isAngle ? value / DEGREE : value;
    if (!Number.isFinite(shown)) return "–";
    const size = Math.abs(shown);
    const text =
        size !== 0 && (size < 1e-4 || size >= 1e7)
            ? shown.toExponential(digits - 2).replace(/\.?0+e/u, "e").replace("e+", "e")
            : String(Number(shown.toPrecision(digits)));
    return (text === "-0" ? "0" : text).replaceAll("-", "−") + (isAngle ? "°" : "");
}

/** The number that somebody wrote; null if it is none. A plain number is in degrees if it is an angle. */
export function read(text: string, isAngle = false): number | null {
    const match = /^\s*([+\-−]?[\d.,]+(?:e[+\-−]?\d+)?)\s*(°|deg|rad|rpm)?\s*$/iu.exec(text);
    if (match === null) return null;
    const value = Number((match[1] ?? "").replaceAll("−", "-").replace(",", "."));
    if (!Number.isFinite(value)) return null;
    const unit = match[2]?.toLowerCase();
    if (unit === "rpm") return (value * Math.PI) / 30;
    if (unit === "rad") return value;
    return isAngle || unit !== undefined ? value * DEGREE : value;
}

/** A step of 1, 2 or 5 times a power of ten, near a two-hundredth of a range. */
export function stepOf(range: number): number {
    const rough = range / 200;
    const power = 10 ** Math.floor(Math.log10(rough));
    const lead = rough / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

export function kilobytes(length: number): string {
    return (length / 1000).toFixed(1);
}
