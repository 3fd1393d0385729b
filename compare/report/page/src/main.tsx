import { render } from "preact";

import { read_chunk } from "./chunk";
import type { Report } from "./format";

const { header } = await read_chunk<Report>("report");
render(<h1>{header.sentence}</h1>, document.getElementById("page")!);
