'use strict';
// What the scripts of all report pages share.
const $ = id => document.getElementById(id);
const report = JSON.parse($('data').textContent);
function element(tag, text, className) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (className) e.className = className;
  return e;
}
/// A part of a drawing (SVG), at the end of its parent.
function shape(parent, tag, attributes, text) {
  const e = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text !== undefined) e.textContent = text;
  parent?.append(e);
  return e;
}
