// Reads the chunks of a report file: format.ts says what they are.
import type { ArrayInfo, ArrayRef, ChunkHeader, ElementType } from "./format";

const kArrayTypes = {
    u8: Uint8Array,
    u16: Uint16Array,
    u32: Uint32Array,
    i32: Int32Array,
    f32: Float32Array,
    f64: Float64Array,
} as const;

export type ArrayOf<Type extends ElementType> = InstanceType<(typeof kArrayTypes)[Type]>;
type AnyArray = ArrayOf<ElementType>;

/// A chunk that was read: its header, and its arrays.
export class Chunk<Header extends ChunkHeader> {
    readonly header: Header;
    private readonly arrays: AnyArray[];

    constructor(header: Header, arrays: AnyArray[]) {
        this.header = header;
        this.arrays = arrays;
    }

    /// The array of that index, which must be of that type.
    array<Type extends ElementType>(type: Type, ref: ArrayRef): ArrayOf<Type> {
        const array = this.arrays[ref];
        if (!(array instanceof kArrayTypes[type])) throw new Error(`Array ${ref} of the report is no ${type}.`);
        return array as ArrayOf<Type>;
    }

    /// The array of that index, of any unsigned type.
    indices(ref: ArrayRef): Uint8Array | Uint16Array | Uint32Array {
        const array = this.arrays[ref];
        if (array instanceof Uint8Array || array instanceof Uint16Array || array instanceof Uint32Array) return array;
        throw new Error(`Array ${ref} of the report holds no indices.`);
    }
}

/// The chunk in the element with that id. Rejects where it is missing or damaged.
export async function read_chunk<Header extends ChunkHeader>(id: string): Promise<Chunk<Header>> {
    const element = document.getElementById(id);
    if (element === null) throw new Error(`The report has no chunk ${id}.`);
    const bytes = await unzipped(from_base64(element.textContent ?? ""));
    const length = new DataView(bytes.buffer).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length))) as Header;
    const arrays: AnyArray[] = [];
    let at = 4 + length;
    for (const info of header.arrays) {
        const { array, end } = from_planes(info, bytes, at);
        if (info.xor !== undefined) combine(array, arrays[info.xor]);
        arrays.push(array);
        at = end;
    }
    if (at !== bytes.length) throw new Error(`The chunk ${id} of the report is damaged.`);
    return new Chunk(header, arrays);
}

function from_base64(text: string): Uint8Array<ArrayBuffer> {
    const binary = atob(text.trim());
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

async function unzipped(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

function from_planes(info: ArrayInfo, bytes: Uint8Array, at: number): { array: AnyArray; end: number } {
    const array = new kArrayTypes[info.type](info.count);
    const size = array.BYTES_PER_ELEMENT;
    const end = at + size * info.count;
    if (end > bytes.length) throw new Error("A chunk of the report ends too early.");
    const out = new Uint8Array(array.buffer);
    for (let plane = 0; plane < size; ++plane)
        for (let i = 0; i < info.count; ++i) out[i * size + plane] = bytes[at++]!;
    return { array, end };
}

function combine(array: AnyArray, base: AnyArray | undefined): void {
    if (base === undefined || base.byteLength !== array.byteLength) throw new Error("The report is damaged.");
    const out = new Uint8Array(array.buffer);
    const other = new Uint8Array(base.buffer);
    for (let i = 0; i < out.length; ++i) out[i]! ^= other[i]!;
}
