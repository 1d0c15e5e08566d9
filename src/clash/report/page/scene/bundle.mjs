// bundle.mjs OUTPUT: joins main.js and what it imports into one script, for embed.cmake.
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

await build({
  entryPoints: [join(dirname(fileURLToPath(import.meta.url)), 'main.js')],
  outfile: process.argv[2],
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  charset: 'ascii',
  legalComments: 'inline',
  logLevel: 'warning',
});
