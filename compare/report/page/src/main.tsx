// The page: the first screen, and the case that the address names.
import { render } from "preact";
import { useEffect } from "preact/hooks";

import { read_chunk } from "./chunk";
import type { Report } from "./format";
import { CasePage } from "./model";
import { Overview } from "./overview";
import { use_route } from "./route";
import { worst_of } from "./verdicts";

const kProject = "loopcheck";

function Page({ report }: { report: Report }) {
    const route = use_route();
    const [only, ...others] = report.cases;
    const alone = only !== undefined && others.length === 0;
    const shown = route ?? (alone ? { case_index: 0, result_index: worst_of(only.results) } : null);
    const case_shown = shown && report.cases[shown.case_index];
    useEffect(() => {
        document.title = [case_shown?.model, `${kProject} ${report.command}`].filter(Boolean).join(" \u2013 ");
        if (!alone) scrollTo(0, 0);
    }, [report, case_shown, alone]);
    // A lone case stands below its table: what was asked for is brought into view.
    useEffect(() => {
        if (alone && route !== null) document.getElementById("case")?.scrollIntoView();
    }, [alone, route]);
    return (
        <>
            <header>
                <p class="brand"><a href="#/">{kProject}</a> {report.command} report</p>
                <Sentence report={report} />
            </header>
            <main>
                {(alone || shown === null) && (
                    <>
                        <Unreadable report={report} />
                        {report.cases.length > 0 && <Overview report={report} />}
                    </>
                )}
                {shown !== null && <CasePage report={report} {...shown} is_alone={alone} />}
            </main>
            <footer><Versions report={report} /></footer>
        </>
    );
}

/// The verdict in a sentence, with the sign of the exit code.
function Sentence({ report }: { report: Report }) {
    const agrees = report.exit_code === 0;
    return (
        <>
            <h1 class={agrees ? "identical" : "differs"}>
                <span class="sign" aria-hidden="true">{agrees ? "\u2713" : "\u2717"}</span> {report.sentence}
            </h1>
            <p class="muted">
                {kProject} {report.version}, levels 0 to {report.levels}, exit code {report.exit_code};{" "}
                {report.subjects.map((one) => `${one.name} ${one.version}`).join(", ")}
            </p>
        </>
    );
}

function Unreadable({ report }: { report: Report }) {
    if (report.unreadable.length === 0) return null;
    return (
        <section class="failed" aria-labelledby="unreadable">
            <h2 id="unreadable">Not compared</h2>
            <ul>{report.unreadable.map((one, i) => <li key={i}>{one.model}: {one.error}</li>)}</ul>
        </section>
    );
}

function Versions({ report }: { report: Report }) {
    return (
        <details>
            <summary>Subjects, and what they can do</summary>
            <dl>
                {report.subjects.map((one) => (
                    <div key={one.name}>
                        <dt>{one.name} {one.version}, {one.precision}</dt>
                        <dd>{one.supports}</dd>
                    </div>
                ))}
            </dl>
        </details>
    );
}

const page = document.getElementById("page")!;
try {
    const { header } = await read_chunk<Report>("report");
    page.replaceChildren();
    render(<Page report={header} />, page);
} catch (error) {
    page.setAttribute("role", "alert");
    page.textContent = `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
}
