// The verdicts: their order, sign and colour.
import type { ResultSummary, VerdictName } from "./format";

interface Look {
    /// Worst first when sorted by it.
    rank: number;
    sign: string;
    /// Name of the CSS class.
    tone: string;
    meaning: string;
}

export const kVerdicts: Record<VerdictName, Look> = {
    failed: { rank: 0, sign: "!", tone: "failed", meaning: "a subject gave an error or broke its promise" },
    differs: { rank: 1, sign: "\u2260", tone: "differs", meaning: "the masks, the rules or the topology differ" },
    "known deviation": {
        rank: 2, sign: "\u25c6", tone: "named", meaning: "differs as listed, by the predicted amount",
    },
    "within rounding": {
        rank: 3, sign: "\u2248", tone: "rounding", meaning: "no further apart than rounding explains",
    },
    identical: { rank: 4, sign: "=", tone: "identical", meaning: "every coordinate has the same bits" },
    "not supported": { rank: 5, sign: "\u2013", tone: "unsupported", meaning: "a subject says that it cannot do this" },
};

export const kVerdictNames = Object.keys(kVerdicts) as VerdictName[];

/// Index of the first of the worst.
export function worst_of(results: ResultSummary[]): number {
    const ranks = results.map((result) => kVerdicts[result.verdict].rank);
    return Math.max(0, ranks.indexOf(Math.min(...ranks)));
}

export function Verdict({ of }: { of: VerdictName }) {
    const { sign, tone } = kVerdicts[of];
    return (
        <span class={`verdict ${tone}`}>
            <span class="sign" aria-hidden="true">{sign}</span> {of}
        </span>
    );
}
