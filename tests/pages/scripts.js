"use strict";
// Loads scripts of the pages without a browser.
const fs = require("node:fs");
const path = require("node:path");

const folder = path.join(__dirname, "../../src/wheelwright/output/page/assets");

// The constants that these scripts define, e.g. { planeView } of "plane_view"; in the order of the page, each sees those before
// it.
function load(...names) {
  const sources = names.map((name) => fs.readFileSync(path.join(folder, `${name}.js`), "utf8"));
  const constants = names.map((name) => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase()));
  return new Function(`${sources.join("\n")}\nreturn { ${constants.join(", ")} };`)();
}

// As the pages get arrays: the bytes of a typed array as base64.
const encoded = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");

module.exports = { folder, load, encoded };
