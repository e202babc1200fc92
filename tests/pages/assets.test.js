"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");
const { folder } = require("./scripts.js");

// The files of each asset, in the order of CMake.
const cmake = fs.readFileSync(path.join(__dirname, "../../src/wheelwright/CMakeLists.txt"), "utf8");
const assets = Object.fromEntries([...cmake.matchAll(/^ +(\w+_js)=([\w.|]+?\.js)\)?$/gm)].map(([, name, files]) => [name, files.split("|")]));
const pages = { report: ["formats_js", "parts_js", "report_js"], watch: ["formats_js", "parts_js", "stage_js", "watch_js"],
  designs: ["formats_js", "designs_js"] };
const filesOf = (page) => pages[page].flatMap((asset) => assets[asset]);
const source = (file) => fs.readFileSync(path.join(folder, file), "utf8");
const constantOf = (file) => source(file).match(/^const (\w+) = \(\(\) => \{$/m)?.[1];

test("every script is part of exactly one asset, and every asset of a page", () => {
  assert.deepEqual(Object.values(assets).flat().sort(), fs.readdirSync(folder).filter((file) => file.endsWith(".js")).sort());
  assert.deepEqual([...new Set(Object.values(pages).flat())].sort(), Object.keys(assets).sort());
});

test("the scripts of a page can be parsed together", () => {
  for (const page of Object.keys(pages)) new vm.Script(filesOf(page).map(source).join(""), { filename: page });
});

test("a script stands behind those whose constants it uses", () => {
  let uses = 0;
  for (const page of Object.keys(pages)) {
    const files = filesOf(page);
    files.forEach((file, k) => {
      const constant = constantOf(file);
      if (!constant) return;
      const use = new RegExp(`(?<![.\\w])${constant}\\.\\w|\\} = ${constant}\\b`);
      for (const earlier of files.slice(0, k)) assert.doesNotMatch(source(earlier), use, `${page}: ${earlier} uses ${constant}`);
      uses += files.slice(k + 1).filter((later) => use.test(source(later))).length;
    });
  }
  assert.ok(uses >= 15, String(uses));
});
