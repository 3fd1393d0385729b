// How fast vertices of each class come to their limits.
import { useMemo } from "preact/hooks";

import type { Case } from "../format";
import { Magnitudes } from "./magnitudes";
import type { Series } from "./magnitudes";
import { short } from "../numbers";

type Points = Case["convergence"];

export function ConvergencePlot({ points }: { points: Points }) {
    const made = useMemo(() => {
        const levels = [...new Set(points.map((p) => p.level))].sort((a, b) => a - b);
        return {
            categories: levels.map(String),
            series: series_of(points, levels),
            reading: reading_of(points),
            numbers: {
                head: ["class", "level", "vertices", "distance, model units", "factor in the end"],
                rows: points.map((p) => [
                    p.class,
                    String(p.level),
                    String(p.vertices),
                    short(p.distance),
                    p.factor === null ? "not known" : short(p.factor),
                ]),
            },
        };
    }, [points]);
    if (points.length === 0) return <p>No distances to the limit were measured.</p>;
    return (
        <Magnitudes
            title="Convergence to the limit by vertex class"
            category_label="level"
            magnitude_label="largest distance to the limit, model units"
            zero_label="0"
            ordered
            {...made}
        />
    );
}

function series_of(points: Points, levels: number[]): Series[] {
    const series = new Map<string, Series>();
    for (const p of points) {
        const one = series.get(p.class) ?? { name: p.class, magnitudes: [], factor: p.factor ?? undefined };
        series.set(p.class, one);
        one.magnitudes.push({ category: levels.indexOf(p.level), value: p.distance });
    }
    for (const one of series.values()) one.magnitudes.sort((a, b) => a.category - b.category);
    return [...series.values()].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
}

function reading_of(points: Points): string {
    const known = points.filter((p) => p.factor !== null);
    if (known.length === 0) return "No factor is known for these classes.";
    const slowest = known.reduce((most, p) => ((p.factor ?? 0) > (most.factor ?? 0) ? p : most));
    return (
        "In the end a level multiplies the distance by the factor of its class, which the thin lines show; " +
        `${slowest.class} is the slowest, by ${short(slowest.factor)} a level.`
    );
}
