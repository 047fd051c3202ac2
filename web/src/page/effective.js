/* What the picture is drawn with, of a `state` event: presets, looks and defaults taken in. */

const usual = { on: true, color: '#000000', width: 2 };

/** {on, color, width (px)} of a class of lines. */
export const line_of = (state, name) => ({ ...usual, ...state.effective?.lines?.[name] });

/** #rrggbb of a colour with or without alpha; null: none. */
export const hex_of = (color) => (/^#[0-9a-f]{6}/i.test(color ?? '') ? color.slice(0, 7).toLowerCase() : null);

/** An effective value; where the engine tells none of that name, the option's own word, or what is usual. */
export const value_of = (state, name, otherwise) => state.effective?.[name] ?? state.words[name] ?? otherwise;
