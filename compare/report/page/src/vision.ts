// How far apart two colours look, also to people who see fewer of them.

/// sRGB bytes.
export type Rgb = readonly [number, number, number];

/// What linear sRGB becomes in the eye: all cones, then without the long, the middle and the short ones, at full
/// severity [Machado09].
const kVisions = [
    [1, 0, 0, 0, 1, 0, 0, 0, 1],
    [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
    [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881],
    [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039],
] as const;

/// A colour as each of `kVisions` sees it: three OKLab coordinates [Ottosson20] a vision.
export type Appearance = readonly number[];

function linear(byte: number): number {
    const c = byte / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

function oklab(r: number, g: number, b: number): number[] {
    const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return [
        0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
        1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
        0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
    ];
}

const between_0_and_1 = (x: number): number => Math.max(0, Math.min(1, x));

export function appearance([red, green, blue]: Rgb): Appearance {
    const [r, g, b] = [linear(red), linear(green), linear(blue)];
    return kVisions.flatMap((m) => oklab(
        between_0_and_1(m[0] * r + m[1] * g + m[2] * b),
        between_0_and_1(m[3] * r + m[4] * g + m[5] * b),
        between_0_and_1(m[6] * r + m[7] * g + m[8] * b)));
}

/// Lightness in OKLab, 0 black to 1 white.
export function lightness(colour: Rgb): number {
    return appearance(colour)[0] ?? 0;
}

/// Distance in OKLab in the eye that tells the two least apart; 1 from black to white.
export function distance(a: Appearance, b: Appearance): number {
    let least = Infinity;
    for (let i = 0; i + 2 < a.length; i += 3) {
        least = Math.min(least, Math.hypot(a[i]! - b[i]!, a[i + 1]! - b[i + 1]!, a[i + 2]! - b[i + 2]!));
    }
    return least;
}
