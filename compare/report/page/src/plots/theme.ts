// How series are told apart: a colour and a symbol each, so that neither is needed alone.
import type { SymbolName } from "@observablehq/plot";

/// Custom properties of plots.css; told apart by most people, and 3 : 1 against the paper, light and dark.
const kColours = [0, 1, 2, 3, 4, 5].map((i) => `var(--series-${i})`);
const kSymbols: readonly SymbolName[] = ["circle", "square", "triangle", "diamond", "cross", "star", "wye"];

export interface SeriesStyle {
    colour: string;
    symbol: SymbolName;
}

/// The style of series i: 42 are different.
export function series_style(i: number): SeriesStyle {
    return { colour: kColours[i % kColours.length]!, symbol: kSymbols[i % kSymbols.length]! };
}

/// Series that a plot shows; where there are more, the largest.
export const kMostSeries = 12;
/// Places along a plot that are not levels; where there are more, those of the largest values.
export const kMostCategories = 24;
