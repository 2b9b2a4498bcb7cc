"use strict";

// What all parts of a report use.

/** An element with attributes (functions among them are listeners) and children, texts among them. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** The same of SVG. */
function makeSvg(tag, attributes = {}, text = "") {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.textContent = text;
  return element;
}

function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

/** A number to so many significant digits, without zeros at its end. */
function inDigits(value, digits = 4) {
  return value === 0 ? "0" : String(Number(value.toPrecision(digits)));
}

/** The data of a section, which it holds as JSON. */
function takeData(section) {
  return JSON.parse(section.querySelector("script").textContent);
}

/** Colours at share 0 … 1 of stops. */
function blend(stops, share) {
  const at = clamp(share, 0, 1) * (stops.length - 1);
  const first = Math.min(Math.floor(at), stops.length - 2);
  return stops[first].map((from, c) => Math.round(from + (at - first) * (stops[first + 1][c] - from)));
}
