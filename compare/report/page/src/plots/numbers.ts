// Numbers as a reader sees them.

/// Three significant digits; what is not a number is said so.
export function number_text(value: number | null): string {
    if (value === null || !Number.isFinite(value)) return "not finite";
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e-3 && size < 1e6 ? String(Number(value.toPrecision(3))) : exponential(value);
}

function exponential(value: number): string {
    return value.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e");
}

/// 10^decade.
export function power_text(decade: number): string {
    return Math.abs(decade) <= 3 ? String(Number(`1e${decade}`)) : `1e${decade}`;
}

/// "1 vertex", "2 vertices".
export function counted(count: number, one: string, several: string): string {
    return `${count.toLocaleString("en")} ${count === 1 ? one : several}`;
}
