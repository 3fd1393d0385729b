// What tests of the legend need, in one script.
import { h, render } from "preact";

import { ClassScale, ErrorScale } from "../src/colours";
import { Legend } from "../src/legend";

export { ClassScale, ErrorScale };

export function show(scale: ErrorScale | ClassScale, title: string, host: HTMLElement): void {
    render(h(Legend, { scale, title }), host);
}
