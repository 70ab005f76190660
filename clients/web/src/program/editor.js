// @ts-check
// The editor of programs: CodeMirror in a shadow root, where its styles are sheets that the page's policy allows. A bundle of its
// own, which is loaded when the panel Program opens.
import { basicSetup, EditorView } from "codemirror";
import { indentWithTab } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import { HighlightStyle, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { EditorSelection, EditorState, Prec } from "@codemirror/state";
import { keymap } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { completions } from "./completions.js";

const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", color: "var(--ink)", backgroundColor: "var(--sheet)" },
  "&.cm-focused": { outline: "none" },
  ".cm-scroller": { fontFamily: "var(--mono)" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-gutters": { backgroundColor: "var(--sunk)", color: "var(--soft)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--select) !important" },
  ".cm-tooltip, .cm-panels": { color: "var(--ink)", backgroundColor: "var(--sunk)", borderColor: "var(--line)" },
  ".cm-tooltip.cm-completionInfo": { maxWidth: "20rem" },
  ".cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]": { color: "var(--ink)", backgroundColor: "var(--select)" },
  ".cm-textfield, .cm-button": { color: "var(--ink)", backgroundColor: "var(--sheet)", backgroundImage: "none", borderColor: "var(--edge)" },
});

/** The colours of the page, in place of those of CodeMirror, which suit a white ground only. */
const colours = syntaxHighlighting(HighlightStyle.define([
  { tag: tags.keyword, color: "var(--past)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--good)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--focus)" },
  { tag: [tags.definition(tags.function(tags.variableName)), tags.className], color: "var(--other)" },
  { tag: tags.comment, color: "var(--soft)" },
  { tag: tags.invalid, color: "var(--alarm)" },
]));

/**
 * @param {HTMLElement} host
 * @param {{onChange: (text: string) => void, onRun: () => void}} parts `onChange`: the text of the file that is shown has changed
 */
export function openEditor(host, { onChange, onRun }) {
  const root = host.attachShadow({ mode: "open" });
  const run = Prec.highest(keymap.of([{ key: "Mod-Enter", run: () => (onRun(), true) }]));
  const changed = EditorView.updateListener.of(({ docChanged, state }) => docChanged && onChange(state.doc.toString()));
  const name = EditorView.contentAttributes.of({ "aria-label": "Program in Python", tabindex: "0" });
  const extensions = [run, basicSetup, python(), completions, keymap.of([indentWithTab]), indentUnit.of("    "), EditorView.lineWrapping, theme, colours, changed, name];
  const view = new EditorView({ parent: root, root });
  /** Of files that are not shown: cursor, and what can be undone. @type {WeakMap<object, EditorState>} */
  const states = new WeakMap();
  /** @type {object | null} */
  let shown = null;
  return {
    /** @param {{text: string}} file */
    show(file) {
      if (shown) states.set(shown, view.state);
      shown = file;
      const state = states.get(file);
      view.setState(state?.doc.toString() === file.text ? state : EditorState.create({ doc: file.text, extensions }));
    },
    /** Puts the cursor at a line, from 1. @param {number} number */
    goTo(number) {
      const line = view.state.doc.line(Math.min(Math.max(number, 1), view.state.doc.lines));
      view.dispatch({ selection: EditorSelection.cursor(line.from), scrollIntoView: true });
      view.focus();
    },
    focus: () => view.focus(),
  };
}
