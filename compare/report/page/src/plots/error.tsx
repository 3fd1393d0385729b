// The largest error a level and vertex class, and what is proven of it.
import { useMemo } from "preact/hooks";

import type { ClassJson, ComparisonJson } from "../format";
import type { Cell, Numbers } from "./figure";
import { Magnitudes } from "./magnitudes";
import type { Series } from "./magnitudes";
import { counted, short } from "../numbers";

/// What this plot needs of a level.
interface ClassLevel {
    level: number;
    classes: ClassJson[];
}

/// Of the refinement, and of limits where they were compared.
export function ErrorPlot({ comparison }: { comparison: ComparisonJson }) {
    const limits = useMemo(
        () =>
            comparison.limits?.levels.map(({ level, classes }) => ({
                level,
                classes: classes.map((c) => ({ ...c.position, class: c.class })),
            })),
        [comparison],
    );
    return (
        <>
            <LevelErrors comparison={comparison} what="refinement" levels={comparison.levels} />
            {limits && <LevelErrors comparison={comparison} what="limit positions" levels={limits} />}
        </>
    );
}

interface LevelErrorsProps {
    comparison: ComparisonJson;
    what: string;
    levels: ClassLevel[];
}

function LevelErrors({ comparison, what, levels }: LevelErrorsProps) {
    const made = useMemo(
        () => ({
            categories: levels.map((l) => String(l.level)),
            series: series_of(levels),
            reading: reading_of(levels),
            numbers: numbers_of(levels),
        }),
        [levels],
    );
    const title = `Largest difference of ${comparison.subject} and ${comparison.reference} by vertex class: ${what}`;
    return (
        <Magnitudes
            title={title}
            category_label="level"
            magnitude_label="largest |a - b|, u M"
            zero_label="identical"
            bound_name="proven bound, largest of the class"
            ordered
            {...made}
        />
    );
}

/// In u M; infinite where it is not finite.
function size_of(c: ClassJson): number {
    return c.difference.not_finite > 0 ? Infinity : (c.difference.max_in_uM ?? Infinity);
}

function series_of(levels: ClassLevel[]): Series[] {
    const series = new Map<string, Series>();
    levels.forEach(({ classes }, category) => {
        for (const c of classes) {
            const one = series.get(c.class) ?? { name: c.class, magnitudes: [] };
            series.set(c.class, one);
            one.magnitudes.push({
                category,
                value: size_of(c),
                bound: c.largest_bound_in_uM ?? Infinity,
                beyond: c.beyond_bound > 0,
            });
        }
    });
    return [...series.values()].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
}

function reading_of(levels: ClassLevel[]): string {
    const all = levels.flatMap(({ level, classes }) => classes.map((c) => ({ level, c })));
    const [first, ...others] = all;
    if (!first) return "No vertices were compared.";
    const largest = others.reduce((most, one) => (size_of(one.c) > size_of(most.c) ? one : most), first);
    const size = size_of(largest.c);
    const where = `(${largest.c.class}, level ${largest.level})`;
    const beyond = all.reduce((sum, { c }) => sum + c.beyond_bound, 0);
    if (size === 0 && beyond === 0) return "Identical at every level.";
    const amount = size < Infinity ? `At most ${short(size)} u M ${where}` : `Not finite in places ${where}`;
    return beyond === 0
        ? `${amount}; every vertex is within its bound.`
        : `${amount}; ${counted(beyond, "vertex is", "vertices are")} beyond what rounding explains.`;
}

function numbers_of(levels: ClassLevel[]): Numbers {
    const rows = levels.flatMap(({ level, classes }) =>
        classes.map((c): Cell[] => [
            c.class,
            String(level),
            String(c.vertices),
            String(c.difference.identical),
            size_of(c) < Infinity ? short(size_of(c)) : `${c.difference.not_finite} not finite`,
            short(c.largest_bound_in_uM),
            short(c.bound_use),
            c.beyond_bound > 0 ? { text: String(c.beyond_bound), style: "beyond" } : "0",
        ]),
    );
    return {
        head: ["class", "level", "vertices", "identical", "largest, u M", "bound, u M", "bound used", "beyond"],
        rows,
    };
}
