// What every plot has around it: a title, what it shows in a sentence, and its numbers as a table.
import * as Plot from "@observablehq/plot";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";

/// A cell: a text, or one with a class of plots.css.
export type Cell = string | { text: string; style: "name" | "beyond" };

export interface Numbers {
    head: string[];
    /// The first cell of a row is its name.
    rows: Cell[][];
}

interface FigureProps {
    title: string;
    reading: string;
    numbers: Numbers;
    children: ComponentChildren;
}

export function Figure({ title, reading, numbers, children }: FigureProps) {
    return (
        <figure class="plot">
            <figcaption>
                <strong>{title}</strong>
                <span>{reading}</span>
            </figcaption>
            {children}
            <details>
                <summary>Numbers: {title}</summary>
                <NumberTable {...numbers} />
            </details>
        </figure>
    );
}

export function NumberTable({ head, rows }: Numbers) {
    return (
        <div class="numbers" tabIndex={0} role="group" aria-label="Table of numbers">
            <table>
                <thead>
                    <tr>
                        {head.map((text, i) => (
                            <th key={text} scope="col" class={i === 0 ? "name" : undefined}>
                                {text}
                            </th>
                        ))}
                    </tr>
                </thead>
                <tbody>
                    {rows.map((row, r) => (
                        <tr key={r}>{row.map((cell, i) => cell_of(cell, i))}</tr>
                    ))}
                </tbody>
            </table>
        </div>
    );
}

function cell_of(cell: Cell, i: number) {
    const { text, style } = typeof cell === "string" ? { text: cell, style: undefined } : cell;
    if (i > 0) return <td key={i} class={style}>{text}</td>;
    return <th key={i} scope="row" class="name">{text}</th>;
}

interface CanvasProps {
    label: string;
    height: number;
    /// The plot at a width in pixels.
    draw: (width: number) => Plot.PlotOptions;
}

const kLeastWidth = 280;
const kUnseenWidth = 640;

/// A plot as wide as there is place; its height is fixed, so that nothing moves when it is drawn.
export function PlotCanvas({ label, height, draw }: CanvasProps) {
    const place = useRef<HTMLDivElement>(null);
    useLayoutEffect(() => {
        const element = place.current!;
        let drawn = 0;
        const redraw = () => {
            const width = Math.max(kLeastWidth, element.clientWidth || kUnseenWidth);
            if (width === drawn) return;
            drawn = width;
            const plot = Plot.plot({ ...draw(width), width, height, figure: false });
            plot.setAttribute("role", "img");
            plot.setAttribute("aria-label", label);
            // Names of its groups, which have no role.
            for (const group of plot.querySelectorAll("g[aria-label]")) group.removeAttribute("aria-label");
            element.replaceChildren(plot);
        };
        redraw();
        const watch = new ResizeObserver(redraw);
        watch.observe(element);
        return () => watch.disconnect();
    }, [label, height, draw]);
    return <div class="plot-canvas" ref={place} style={{ minHeight: `${height}px` }} />;
}
