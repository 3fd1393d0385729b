/// `make`, which is called again only when one of its inputs is another one than last time.
export function kept<Inputs extends readonly unknown[], Value>(
    make: (...inputs: Inputs) => Value,
): (...inputs: Inputs) => Value {
    let last: { inputs: Inputs; value: Value } | null = null;
    return (...inputs) => {
        const before = last;
        if (before !== null && inputs.every((input, i) => Object.is(input, before.inputs[i]))) return before.value;
        const value = make(...inputs);
        last = { inputs, value };
        return value;
    };
}
