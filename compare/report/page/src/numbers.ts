// Numbers as text.

/// C's hexadecimal fraction, exact: 0x1.306594af4f0d8p+0. As in the JSON report.
export function hexfloat(x: number): string {
    if (Number.isNaN(x)) return "nan";
    const sign = x < 0 || Object.is(x, -0) ? "-" : "";
    if (!Number.isFinite(x)) return `${sign}inf`;
    if (x === 0) return `${sign}0x0p+0`;
    const bits = new DataView(new ArrayBuffer(8));
    bits.setFloat64(0, x);
    const biased = (bits.getUint16(0) >> 4) & 0x7ff;
    const fraction = bits.getBigUint64(0) & 0xfffffffffffffn;
    // Subnormal numbers have no leading one.
    const [leading, exponent] = biased === 0 ? ["0", -1022] : ["1", biased - 1023];
    const digits = fraction.toString(16).padStart(13, "0").replace(/0+$/, "");
    return `${sign}0x${leading}${digits === "" ? "" : `.${digits}`}p${exponent < 0 ? "-" : "+"}${Math.abs(exponent)}`;
}

/// Three digits: 0.0434, 1.43e+14, 0, "not finite".
export function short(x: number | null): string {
    if (x === null || !Number.isFinite(x)) return "not finite";
    if (x === 0) return "0";
    const magnitude = Math.abs(x);
    return magnitude >= 1e-3 && magnitude < 1e4 ? String(Number(x.toPrecision(3))) : x.toExponential(2);
}

/// 1234567 as 1 234 567, with narrow spaces.
export function grouped(n: number): string {
    return String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

/// "1 vertex", "3 vertices".
export function counted(n: number, one: string, many = `${one}s`): string {
    return `${grouped(n)} ${n === 1 ? one : many}`;
}

/// 10 to that power: 0.01, 1, 1e14.
export function power(decade: number): string {
    return Math.abs(decade) <= 3 ? String(Number(`1e${decade}`)) : `1e${decade}`;
}
