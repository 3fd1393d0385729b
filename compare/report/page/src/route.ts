// The addresses within a report: #/ is the table, #/case/3/0 result 0 of case 3.
import { useEffect, useState } from "preact/hooks";

export interface Route {
    case_index: number;
    result_index: number;
}

export function case_link(case_index: number, result_index: number): string {
    return `#/case/${case_index}/${result_index}`;
}

function current(): Route | null {
    const match = /^#\/case\/(\d+)\/(\d+)$/.exec(location.hash);
    return match && { case_index: Number(match[1]), result_index: Number(match[2]) };
}

/// The case that the address names, kept up to date; null for the table.
export function use_route(): Route | null {
    const [route, set_route] = useState(current);
    useEffect(() => {
        const update = () => set_route(current());
        addEventListener("hashchange", update);
        return () => removeEventListener("hashchange", update);
    }, []);
    return route;
}
