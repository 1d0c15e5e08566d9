// bundle.mjs OUTPUT NOTICES: joins main.js and what it imports into one script, for embed.cmake. The
// script begins with the copyright notices and licences of all that is not Abut's own, and NOTICES
// holds the same text. The build fails if a module that is joined comes without a notice.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const folder = dirname(fileURLToPath(import.meta.url));
const [output, notices] = process.argv.slice(2);

/** The licence that a package of npm comes with. */
function licence(name) {
  const file = ['LICENSE', 'LICENSE.md', 'LICENSE.txt', 'LICENCE']
    .map((each) => join(folder, 'node_modules', name, each))
    .find(existsSync);
  if (!file) throw new Error(`${name} comes without a licence`);
  return readFileSync(file, 'utf8').trim();
}

/** The terms of a licence of the MIT kind, without its title and its lines of copyright. */
function terms(name) {
  const text = licence(name);
  const from = text.indexOf('Permission is hereby granted');
  if (from < 0) throw new Error(`the licence of ${name} is not MIT's`);
  return text.slice(from);
}

/** The lines of comment with which a file begins. */
function head(file) {
  const lines = readFileSync(join(folder, file), 'utf8').split('\n');
  const end = lines.findIndex((line) => !line.startsWith('//'));
  return lines.slice(0, end).map((line) => line.replace(/^\/\/ ?/, '')).join('\n');
}

/** The notices of the modules that were joined: of each package, and of each library that three.js has copied. */
function noticesOf(inputs) {
  const packages = new Set(), copied = [];
  for (const input of inputs) {
    const [, name] = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//) ?? [];
    if (!name) continue;
    if (/\/three\/examples\/jsm\/libs\//.test(input)) copied.push(input);
    else packages.add(name);
  }
  const texts = [...packages].sort().map((name) => {
    const { version } = JSON.parse(readFileSync(join(folder, 'node_modules', name, 'package.json'), 'utf8'));
    return `${name} ${version}\n\n${licence(name)}`;
  });
  for (const file of copied.sort()) {
    const comment = head(file);
    if (!/copyright/i.test(comment) || !/MIT License/.test(comment))
      throw new Error(`${file} begins with no notice of the MIT License: say which licence it has`);
    texts.push(`${file.replace(/^.*\//, '')}\n\n${comment}\n\n${terms('three')}`);
  }
  return texts.join('\n\n\n').replaceAll('©', '(c)');
}

const result = await build({
  entryPoints: [join(folder, 'main.js')],
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  charset: 'ascii',
  legalComments: 'inline',
  logLevel: 'warning',
  metafile: true,
  write: false,
  outfile: output,
});
const inputs = Object.keys(result.metafile.inputs).map((input) => relative(folder, join(process.cwd(), input)));
const text = noticesOf(inputs);
if (!text || text.includes('*/') || /[^\x00-\x7f]/.test(text)) throw new Error('the notices do not fit into a comment');
writeFileSync(output, `/*!\nThis script contains:\n\n${text}\n*/\n${result.outputFiles[0].text}`);
writeFileSync(notices, `${text}\n`);
