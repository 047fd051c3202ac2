/* What the page remembers between visits, in this browser. A browser may forbid that, or hold what another version
 * wrote: then it begins anew each time. */

const prefix = 'drypoint.';

/** The value under a name, or `usual`: where nothing is kept, or something of another type. */
export function recall(name, usual) {
    try {
        const text = localStorage.getItem(prefix + name);
        if (text === null) return usual;
        const value = JSON.parse(text);
        return typeof value === typeof usual ? value : usual;
    } catch {
        return usual;
    }
}

export function remember(name, value) {
    try {
        localStorage.setItem(prefix + name, JSON.stringify(value));
    } catch {
        /* storage is full or forbidden: nothing depends on it */
    }
}
