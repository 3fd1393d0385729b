// The first screen: the verdict, what was compared, and a table that leads to every case.
import type { ComponentChildren } from "preact";
import { useMemo, useRef, useState } from "preact/hooks";

import type { BoundaryName, CaseSummary, Report, ResultSummary, VerdictName } from "./format";
import { counted, grouped, short } from "./numbers";
import { case_link } from "./route";
import { kVerdictNames, kVerdicts } from "./verdicts";

/// Rows drawn at first; more on demand, so that thousands of models do not freeze the page.
const kRowsAtOnce = 300;

const kBoundaryHeads: Record<BoundaryName, string> = {
    "edge-and-corner": "e+c",
    "edge-only": "e",
    none: "none",
};

/// Results of one pair of subjects and kind, for every model and boundary option.
interface Column {
    key: string;
    head: string;
    versus: string;
}

interface Cell {
    case_index: number;
    result_index: number;
    result: ResultSummary;
}

interface Row {
    model: string;
    first_case: CaseSummary;
    /// By column and boundary option.
    cells: Map<string, Cell>;
    worst: Cell | undefined;
}

const key_of = (result: ResultSummary) => `${result.subject}\n${result.reference}\n${result.what}`;
const cell_key = (column: string, boundary: string) => `${column}\n${boundary}`;

function columns_of(report: Report): Column[] {
    const columns = new Map<string, Column>();
    for (const one of report.cases)
        for (const result of one.results) {
            const key = key_of(result);
            if (columns.has(key)) continue;
            const what = result.what === "refinement" ? "" : ` ${result.what}`;
            columns.set(key, { key, head: result.reference + what, versus: result.subject });
        }
    return [...columns.values()];
}

/// Failures first, then named deviations, then the largest difference.
function compare_cells(a: Cell | undefined, b: Cell | undefined): number {
    const rank = (cell: Cell | undefined) => (cell ? kVerdicts[cell.result.verdict].rank : Infinity);
    if (rank(a) !== rank(b)) return rank(a) - rank(b);
    // Where they differ and no number says by how much, it is not finite.
    const size = (cell: Cell | undefined) =>
        cell?.result.largest_in_uM ?? (cell?.result.verdict === "differs" ? Number.MAX_VALUE : 0);
    return size(b) - size(a);
}

function rows_of(report: Report): Row[] {
    const rows = new Map<string, Row>();
    report.cases.forEach((one, case_index) => {
        let row = rows.get(one.model);
        if (row === undefined) {
            row = { model: one.model, first_case: one, cells: new Map(), worst: undefined };
            rows.set(one.model, row);
        }
        for (const [result_index, result] of one.results.entries()) {
            const cell = { case_index, result_index, result };
            row.cells.set(cell_key(key_of(result), one.boundary), cell);
            if (row.worst === undefined || compare_cells(cell, row.worst) < 0) row.worst = cell;
        }
    });
    return [...rows.values()];
}

interface Filters {
    text: string;
    /// Verdicts that are shown; all where empty.
    verdicts: ReadonlySet<VerdictName>;
}

function passes(row: Row, filters: Filters): boolean {
    if (!row.model.toLowerCase().includes(filters.text.toLowerCase())) return false;
    return filters.verdicts.size === 0 || [...row.cells.values()].some((c) => filters.verdicts.has(c.result.verdict));
}

/// "model", "worst", or the key of a column.
interface Sorting {
    by: string;
    ascending: boolean;
}

function sorted(rows: Row[], boundaries: BoundaryName[], sorting: Sorting): Row[] {
    const worst_in = (row: Row) => {
        if (sorting.by === "worst") return row.worst;
        const cells = boundaries.map((boundary) => row.cells.get(cell_key(sorting.by, boundary)));
        return cells.sort(compare_cells)[0];
    };
    const by_name = (a: Row, b: Row) => a.model.localeCompare(b.model, "en", { numeric: true });
    const order = (a: Row, b: Row) =>
        (sorting.by === "model" ? 0 : compare_cells(worst_in(a), worst_in(b))) || by_name(a, b);
    return [...rows].sort((a, b) => (sorting.ascending ? order(a, b) : -order(a, b)));
}

export function Overview({ report }: { report: Report }) {
    const columns = useMemo(() => columns_of(report), [report]);
    const rows = useMemo(() => rows_of(report), [report]);
    const boundaries = useMemo(() => [...new Set(report.cases.map((one) => one.boundary))], [report]);
    const [filters, set_filters] = useState<Filters>({ text: "", verdicts: new Set() });
    const [sorting, set_sorting] = useState<Sorting>({ by: "worst", ascending: true });
    const [shown, set_shown] = useState(kRowsAtOnce);
    const selected = useMemo(
        () => sorted(rows.filter((row) => passes(row, filters)), boundaries, sorting),
        [rows, boundaries, filters, sorting],
    );
    return (
        <section aria-labelledby="results">
            <h2 id="results">Results</h2>
            {rows.length > 1 && <Filter report={report} filters={filters} on_change={set_filters} />}
            {rows.length > 1 && <p class="count" role="status">
                {selected.length === rows.length
                    ? counted(rows.length, "model")
                    : `${grouped(selected.length)} of ${counted(rows.length, "model")}`}
            </p>}
            <Table
                columns={columns} boundaries={boundaries} rows={selected.slice(0, shown)} sorting={sorting}
                filters={filters}
                on_sort={(by) => set_sorting({ by, ascending: sorting.by === by ? !sorting.ascending : true })}
            />
            {selected.length > shown && (
                <button type="button" onClick={() => set_shown(shown + kRowsAtOnce)}>
                    Show {grouped(Math.min(kRowsAtOnce, selected.length - shown))} more
                </button>
            )}
            <Key with_boundaries={boundaries.length > 1} />
        </section>
    );
}

function Filter({ report, filters, on_change }: {
    report: Report;
    filters: Filters;
    on_change: (filters: Filters) => void;
}) {
    const counts = useMemo(() => {
        const out = new Map<VerdictName, number>();
        for (const one of report.cases)
            for (const { verdict } of one.results) out.set(verdict, (out.get(verdict) ?? 0) + 1);
        return out;
    }, [report]);
    const toggle = (verdict: VerdictName) => {
        const verdicts = new Set(filters.verdicts);
        if (!verdicts.delete(verdict)) verdicts.add(verdict);
        on_change({ ...filters, verdicts });
    };
    return (
        <div class="filters">
            <label>
                Model{" "}
                <input
                    type="search" value={filters.text} placeholder="part of its name"
                    onInput={(event) => on_change({ ...filters, text: event.currentTarget.value })}
                />
            </label>
            <fieldset>
                <legend>Only models with</legend>
                {kVerdictNames.filter((verdict) => counts.has(verdict)).map((verdict) => (
                    <label key={verdict} class={`chip ${kVerdicts[verdict].tone}`}>
                        <input
                            type="checkbox" checked={filters.verdicts.has(verdict)}
                            onChange={() => toggle(verdict)}
                        />
                        {verdict} <span class="muted">{grouped(counts.get(verdict) ?? 0)}</span>
                    </label>
                ))}
            </fieldset>
        </div>
    );
}

function Table({ columns, boundaries, rows, sorting, filters, on_sort }: {
    columns: Column[];
    boundaries: BoundaryName[];
    rows: Row[];
    sorting: Sorting;
    filters: Filters;
    on_sort: (by: string) => void;
}) {
    const body = useRef<HTMLTableSectionElement>(null);
    const many = boundaries.length > 1;
    const sort_state = (by: string) =>
        sorting.by !== by ? "none" : sorting.ascending ? "ascending" : "descending";
    // The boundary options belong to a group of columns, so the groups alone are sorted by.
    const head = (by: string, children: ComponentChildren, span: number) => (
        <th key={by} scope={span > 1 ? "colgroup" : "col"} colSpan={span} rowSpan={many && span === 1 ? 2 : 1}
            aria-sort={sort_state(by)}>
            <button type="button" class="sort" onClick={() => on_sort(by)}>{children}</button>
        </th>
    );
    return (
        <div class="scroll" role="region" aria-label="Results by model" tabIndex={0}>
            <table class="results">
                <thead>
                    <tr>
                        {head("model", "model", 1)}
                        {head("worst", "worst", 1)}
                        {columns.map((column) => head(column.key, (
                            <><span class="versus">{column.versus} against</span>{column.head}</>
                        ), boundaries.length))}
                    </tr>
                    {many && (
                        <tr>
                            {columns.map((column) => boundaries.map((boundary) => (
                                <th key={column.key + boundary} scope="col" class="boundary">
                                    <abbr title={`boundary ${boundary}`}>{kBoundaryHeads[boundary]}</abbr>
                                </th>
                            )))}
                        </tr>
                    )}
                </thead>
                <tbody ref={body} onKeyDown={(event) => move_focus(event, body.current)}>
                    {rows.map((row, index) => (
                        <ResultRow
                            key={row.model} row={row} columns={columns} boundaries={boundaries} filters={filters}
                            is_first={index === 0}
                        />
                    ))}
                </tbody>
            </table>
        </div>
    );
}

function ResultRow({ row, columns, boundaries, filters, is_first }: {
    row: Row;
    columns: Column[];
    boundaries: BoundaryName[];
    filters: Filters;
    is_first: boolean;
}) {
    const { worst } = row;
    return (
        <tr>
            <th scope="row">
                {worst === undefined ? row.model : (
                    <a href={case_link(worst.case_index, worst.result_index)} tabIndex={is_first ? 0 : -1}>
                        {row.model}
                    </a>
                )}
                {row.first_case.faces > 0 && <span class="muted size"> {counted(row.first_case.faces, "face")}</span>}
            </th>
            <td class={worst && kVerdicts[worst.result.verdict].tone}>{worst?.result.verdict}</td>
            {columns.map((column) => boundaries.map((boundary, i) => {
                const cell = row.cells.get(cell_key(column.key, boundary));
                const first = i === 0 ? "first" : "";
                if (cell === undefined) return <td key={column.key + boundary} class={first} />;
                const faded = filters.verdicts.size > 0 && !filters.verdicts.has(cell.result.verdict) ? "faded" : "";
                return (
                    <td key={column.key + boundary} class={`${kVerdicts[cell.result.verdict].tone} ${first} ${faded}`}>
                        <a
                            href={case_link(cell.case_index, cell.result_index)} tabIndex={-1}
                            title={in_words(row.model, column, boundary, cell.result)}
                            aria-label={in_words(row.model, column, boundary, cell.result)}
                        >
                            {in_short(cell.result)}
                        </a>
                    </td>
                );
            }))}
        </tr>
    );
}

function in_short(result: ResultSummary): string {
    const { sign } = kVerdicts[result.verdict];
    const has_number = result.verdict === "within rounding" || result.verdict === "differs";
    return has_number ? `${sign}\u202f${short(result.largest_in_uM)}` : sign;
}

function in_words(model: string, column: Column, boundary: string, result: ResultSummary): string {
    const names = result.deviations.length > 0 ? ` (${result.deviations.join(", ")})` : "";
    const largest = result.largest === null ? "" : `; largest difference ${short(result.largest_in_uM)} u M`;
    return `${model}, ${column.versus} against ${column.head}, boundary ${boundary}: ${result.verdict}${names}${largest}`;
}

// One tab stop for the whole table; arrow keys move among its links.
function move_focus(event: KeyboardEvent, body: HTMLTableSectionElement | null): void {
    const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
    const here = event.target instanceof Element ? event.target.closest("td, th") : null;
    if (step === undefined || body === null || !(here instanceof HTMLTableCellElement)) return;
    const [down, right] = step as [number, number];
    const row = (here.parentElement as HTMLTableRowElement).sectionRowIndex;
    for (let r = row + down, c = here.cellIndex + right; ; r += down, c += right) {
        const cell = body.rows[r]?.cells[c];
        if (cell === undefined) return;
        const link = cell.querySelector("a");
        if (link === null) continue;
        event.preventDefault();
        for (const other of body.querySelectorAll<HTMLElement>("a[tabindex='0']")) other.tabIndex = -1;
        link.tabIndex = 0;
        link.focus();
        return;
    }
}

function Key({ with_boundaries }: { with_boundaries: boolean }) {
    return (
        <dl class="key">
            {kVerdictNames.map((verdict) => (
                <div key={verdict} class={kVerdicts[verdict].tone}>
                    <dt>{kVerdicts[verdict].sign} {verdict}</dt>
                    <dd>{kVerdicts[verdict].meaning}</dd>
                </div>
            ))}
            <div>
                <dt>u M</dt>
                <dd>unit of errors: the roundoff u of the coarser precision times the largest coordinate M</dd>
            </div>
            {with_boundaries && (
                <div>
                    <dt>e+c, e, none</dt>
                    <dd>boundary options edge-and-corner, edge-only and none</dd>
                </div>
            )}
        </dl>
    );
}
