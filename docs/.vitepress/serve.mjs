// Serves a folder on the loopback address, as any host of static files would: node serve.mjs FOLDER [PORT]
import fs from 'node:fs'
import http from 'node:http'
import path from 'node:path'
import { pathToFileURL } from 'node:url'

const types = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.wasm': 'application/wasm', '.png': 'image/png', '.svg': 'image/svg+xml', '.txt': 'text/plain; charset=utf-8', '.woff2': 'font/woff2'
}

// Port 0: any that is free.
export function serve(folder, port = 0) {
  const server = http.createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname)
    let file = path.join(folder, path.normalize(name))
    if (fs.existsSync(file) && fs.statSync(file).isDirectory()) file = path.join(file, 'index.html')
    const isThere = file.startsWith(path.resolve(folder)) && fs.existsSync(file)
    if (!isThere) file = path.join(folder, '404.html')
    response.writeHead(isThere ? 200 : 404, { 'Content-Type': types[path.extname(file)] ?? 'application/octet-stream' })
    fs.createReadStream(file).pipe(response)
  })
  return new Promise((resolve, reject) => {
    server.once('error', reject)
    server.listen(port, '127.0.0.1', () => resolve({ server, address: `http://127.0.0.1:${server.address().port}` }))
  })
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [folder, port = '0'] = process.argv.slice(2)
  try {
    const { address } = await serve(path.resolve(folder), Number(port))
    console.log(`the book is at ${address}/ (Ctrl+C ends it)`)
  } catch (error) {
    console.error(`relief book: port ${port}: ${error.code === 'EADDRINUSE' ? 'is taken; choose another with --port' : error.message}`)
    process.exit(2)
  }
}
