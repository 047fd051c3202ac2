/* Plain words for those of options, and what an option's table entry offers. What is not here is shown as it is. */

const labels = {
    style: {
        paper: 'paper', flat: 'one colour', lambert: 'in light', gooch: 'cool to warm', toon: 'cartoon', hatch: 'hatched',
        halftone: 'dots', pencil: 'pencil',
    },
    hidden: { none: 'not drawn', dashed: 'dashed', dotted: 'dotted', thin: 'thin', solid: 'solid' },
    detail: { auto: 'as a person draws', exact: 'every line', 2: 'finer', 0.5: 'coarser' },
    smooth: { off: 'no', auto: 'as far as it shows' },
    preset: { 'patent-us': 'patent, US', 'patent-epc': 'patent, Europe', iso: 'ISO 128', axidraw: 'pen plotter', laser: 'laser cutter' },
};

export const label_of = (name, word) => labels[name]?.[word] ?? word;

/* Classes of lines that have controls: what a browser's user meets. Sections and their hatching come with --clip. */
export const line_classes = [
    ['silhouette', 'Silhouettes'],
    ['ridge', 'Ridges'],
    ['valley', 'Valleys'],
    ['intersection', 'Intersections'],
    ['border', 'Borders'],
];

/** All classes, in the program's order. */
export const all_classes = [...line_classes.map(([name]) => name), 'section', 'hatching'];

/** The words that an option's value may be; details that are numbers are two of them. */
export function words_of(engine, name) {
    if (name === 'detail') return ['auto', 'exact', '2', '0.5'];
    const option = engine.options.find((each) => each.name === name);
    return (option?.argument ?? '').split('|').filter((word) => /^-?[a-z0-9][a-z0-9-]*$/.test(word));
}

export const pairs_of = (engine, name) => words_of(engine, name).map((word) => [word, label_of(name, word)]);

/** `text` of CLASS=VALUE pieces with one class's value in it. A piece without a class is for all, and comes first. */
export function with_piece(text, name, value) {
    const pieces = text ? text.split(',') : [];
    const kept = pieces.filter((piece) => !piece.startsWith(`${name}=`));
    return [...kept, `${name}=${value}`].join(',');
}

/** A number as the command line has it: no more digits than matter. */
export const digits = (value, most = 4) => String(Number(value.toPrecision(most)));
