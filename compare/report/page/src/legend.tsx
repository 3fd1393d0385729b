// What the colours of a scale mean.
import { css, ErrorScale } from "./colours";
import type { ClassScale, Swatch } from "./colours";

const kRampSteps = 64;
const kNothing = "no positive value";

/// Drawn, and not a background: browsers print no backgrounds.
function Patch({ swatch }: { swatch: Swatch }) {
    return (
        <li>
            <svg viewBox="0 0 1 1" aria-hidden="true"><rect width="1" height="1" fill={css(swatch.colour)} /></svg>
            {swatch.label}
        </li>
    );
}

function Ramp({ scale }: { scale: ErrorScale }) {
    const steps = Array.from({ length: kRampSteps }, (_, i) => i);
    return (
        <div class="ramp" aria-hidden="true">
            <svg viewBox={`0 0 ${kRampSteps} 1`} preserveAspectRatio="none">
                {scale.decades !== null && steps.map((i) => (
                    // To the end, under those that follow: no seam shows.
                    <rect key={i} x={i} width={kRampSteps - i} height="1"
                        fill={css(scale.ramp((i + 0.5) / kRampSteps))} />
                ))}
            </svg>
            <div class="ticks">
                {scale.decades === null && kNothing}
                {scale.ticks().map((tick) => (
                    <span key={tick.label} style={{ left: `${100 * tick.at}%` }}>{tick.label}</span>
                ))}
            </div>
        </div>
    );
}

function spoken_range(scale: ErrorScale): string {
    const ticks = scale.ticks(2);
    return ticks.length === 0
        ? kNothing
        : `from dark, ${ticks[0]!.label} ${scale.unit}, to bright, ${ticks.at(-1)!.label} ${scale.unit}`;
}

/// `title` says what is coloured. As high for every scale of errors, so that nothing below it moves.
export function Legend({ scale, title }: { scale: ErrorScale | ClassScale; title: string }) {
    return (
        <figure class="legend">
            {scale instanceof ErrorScale ? (
                <>
                    <figcaption>
                        {title}, in {scale.unit} <span class="range">{spoken_range(scale)}</span>
                    </figcaption>
                    <Ramp scale={scale} />
                </>
            ) : <figcaption>{title}</figcaption>}
            <ul>{scale.swatches().map((swatch) => <Patch key={swatch.label} swatch={swatch} />)}</ul>
        </figure>
    );
}
