// From numbers to colours: errors on a logarithmic scale, classes and deviations as categories.
import { interpolateViridis } from "d3-scale-chromatic";

import { appearance, distance, lightness } from "./vision";
import type { Appearance, Rgb } from "./vision";

export type { Rgb } from "./vision";

/// What stands beside a colour in a legend.
export interface Swatch {
    colour: Rgb;
    label: string;
}

export interface Scale {
    colour_of(value: number): Rgb;
}

/// Bytes r, g, b of each value.
export function colours_of(scale: Scale, values: ArrayLike<number>): Uint8Array {
    const rgb = new Uint8Array(3 * values.length);
    for (let i = 0; i < values.length; ++i) {
        const [r, g, b] = scale.colour_of(values[i]!);
        rgb[3 * i] = r;
        rgb[3 * i + 1] = g;
        rgb[3 * i + 2] = b;
    }
    return rgb;
}

export function css(colour: Rgb): string {
    return `rgb(${colour.join(" ")})`;
}

function from_hex(hex: string): Rgb {
    const bits = parseInt(hex.slice(1), 16);
    return [bits >> 16, (bits >> 8) & 255, bits & 255];
}

/// Viridis without its yellow end, which for some eyes comes near the colour of "identical".
const kRampColours = 256;
const kRamp: readonly Rgb[] = Array.from({ length: kRampColours },
    (_, i) => from_hex(interpolateViridis(0.85 * i / (kRampColours - 1))));

export const kIdentical: Rgb = from_hex("#e4e6ea");
export const kNotFinite: Rgb = from_hex("#ff00ff");
export const kNotCompared: Rgb = from_hex("#000000");

export interface Tick {
    /// 0 at the least value of the scale, 1 at its largest.
    at: number;
    label: string;
}

/// Rounds a logarithm that is a whole number but for the rounding of a float.
const kWhole = 1e-7;

function decade_label(exponent: number): string {
    return exponent >= -3 && exponent <= 4 ? String(Number(`1e${exponent}`)) : `1e${exponent}`;
}

/// Magnitudes from `least` to `largest`, both positive and finite, on whole decades and logarithmic. Whatever is
/// outside has the colour of the end; 0, what is not finite, and NaN, where nothing was compared, have colours of their own.
export class ErrorScale implements Scale {
    readonly unit: string;
    /// Exponents of its ends; null where there is no positive value, and then nothing is on the ramp.
    readonly decades: readonly [number, number] | null;

    constructor(range: { least: number; largest: number } | null, unit: string) {
        this.unit = unit;
        if (range === null) {
            this.decades = null;
            return;
        }
        const first = Math.floor(Math.log10(range.least) + kWhole);
        const last = Math.ceil(Math.log10(range.largest) - kWhole);
        this.decades = [Math.min(first, last - 1), last];
    }

    /// The scale of all positive finite values among these.
    static of(values: ArrayLike<number>, unit: string): ErrorScale {
        let least = Infinity;
        let largest = 0;
        for (let i = 0; i < values.length; ++i) {
            const value = values[i]!;
            if (!(value > 0 && value < Infinity)) continue;
            if (value < least) least = value;
            if (value > largest) largest = value;
        }
        return new ErrorScale(largest > 0 ? { least, largest } : null, unit);
    }

    colour_of(value: number): Rgb {
        if (value === 0) return kIdentical;
        if (Number.isNaN(value)) return kNotCompared;
        if (!(value > 0 && value < Infinity)) return kNotFinite;
        return this.ramp(this.decades === null ? 1 : this.part(Math.log10(value)));
    }

    /// The colour at that part of the ramp, 0 to 1.
    ramp(part: number): Rgb {
        return kRamp[Math.max(0, Math.min(kRampColours - 1, Math.floor(part * kRampColours)))]!;
    }

    /// At most `most` decades, evenly spaced, with the unit left to the caption.
    ticks(most = 7): Tick[] {
        if (this.decades === null) return [];
        const [first, last] = this.decades;
        const step = Math.max(1, Math.ceil((last - first) / (most - 1)));
        const ticks: Tick[] = [];
        for (let exponent = first; exponent <= last; exponent += step) {
            ticks.push({ at: this.part(exponent), label: decade_label(exponent) });
        }
        return ticks;
    }

    /// What is not on the ramp.
    swatches(): Swatch[] {
        return [{ colour: kIdentical, label: "identical" }, { colour: kNotFinite, label: "not finite" },
            { colour: kNotCompared, label: "not compared" }];
    }

    private part(exponent: number): number {
        const [first, last] = this.decades ?? [0, 1];
        return (exponent - first) / (last - first);
    }
}

export const kNone: Rgb = from_hex("#c4c8cc");

/// The palette of Okabe and Ito [Okabe08] but for its black; then colours that look as different as can be from all
/// before, to every eye. Grows as far as it is asked for; the same on every call.
const palette: Rgb[] = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#f0e442"].map(from_hex);

interface Candidate {
    colour: Rgb;
    looks: Appearance;
    /// Distance to the nearest colour of the palette.
    apart: number;
}
let candidates: Candidate[] | null = null;

function approach(chosen: Rgb): void {
    const looks = appearance(chosen);
    for (const candidate of candidates ?? []) {
        candidate.apart = Math.min(candidate.apart, distance(candidate.looks, looks));
    }
}

/// 512 colours less the nearly black and the nearly white ones, which are lost on a page.
function all_candidates(): Candidate[] {
    const steps = [0, 36, 73, 109, 146, 182, 219, 255];
    const colours = steps.flatMap((r) => steps.flatMap((g) => steps.map((b): Rgb => [r, g, b])));
    return colours
        .filter((colour) => lightness(colour) > 0.4 && lightness(colour) < 0.95)
        .map((colour) => ({ colour, looks: appearance(colour), apart: Infinity }));
}

function palette_colour(index: number): Rgb {
    if (index >= palette.length && candidates === null) {
        candidates = all_candidates();
        for (const colour of [...palette, kNone]) approach(colour);
    }
    while (index >= palette.length) {
        const next = candidates?.reduce((best, candidate) => candidate.apart > best.apart ? candidate : best);
        if (next === undefined || next.apart === 0) return palette[index % palette.length]!;
        palette.push(next.colour);
        approach(next.colour);
    }
    return palette[index]!;
}

/// A colour a name, in the order of the names; "none", and what is no index of a name, is neutral.
export class ClassScale implements Scale {
    readonly names: readonly string[];
    private readonly colours: readonly Rgb[];

    constructor(names: readonly string[]) {
        this.names = names;
        let coloured = 0;
        this.colours = names.map((name) => name === "none" ? kNone : palette_colour(coloured++));
    }

    colour_of(index: number): Rgb {
        return this.colours[index] ?? kNone;
    }

    swatches(): Swatch[] {
        return this.names.map((label, index) => ({ colour: this.colour_of(index), label }));
    }
}
