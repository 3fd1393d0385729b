// Where magnitudes stand on an axis that is logarithmic and has places for what no logarithm has: 0, below, and what is
// not finite, above. Positions are in decades.

export interface Places {
    /// From the lowest place to the highest.
    domain: [number, number];
    zero: number;
    not_finite: number;
    /// Between these are the finite values.
    low: number;
    high: number;
    /// Whole decades to label.
    decades: number[];
}

const kMostTicks = 8;
/// Share of the finite part that a place apart takes.
const kApart = 0.15;

export function has_logarithm(value: number): boolean {
    return value > 0 && value < Infinity;
}

/// The axis that holds all of these.
export function places_of(values: Iterable<number>): Places {
    let least = Infinity;
    let largest = -Infinity;
    for (const value of values) {
        if (!has_logarithm(value)) continue;
        least = Math.min(least, value);
        largest = Math.max(largest, value);
    }
    let low = least === Infinity ? -1 : Math.floor(Math.log10(least));
    let high = least === Infinity ? 1 : Math.ceil(Math.log10(largest));
    if (high - low < 2) [low, high] = [low - 1, high + 1];
    const apart = kApart * (high - low);
    const step = Math.ceil((high - low) / kMostTicks);
    const decades: number[] = [];
    for (let decade = Math.ceil(low / step) * step; decade <= high; decade += step) decades.push(decade);
    return {
        domain: [low - apart, high + apart],
        zero: low - 0.6 * apart,
        not_finite: high + 0.6 * apart,
        low,
        high,
        decades,
    };
}

/// Where a magnitude stands.
export function place(places: Places, value: number): number {
    if (value === 0) return places.zero;
    return has_logarithm(value) ? Math.log10(value) : places.not_finite;
}
