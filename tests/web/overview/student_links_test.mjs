// Links for students: the host by which the teacher reached the page, never one that means the machine itself.
import assert from "node:assert/strict";
import { test } from "node:test";
import { StudentLinks, addressOf, isLocal } from "../../../clients/web/src/overview/student_links.js";

const at = (url) => new URL(url);
const kHere = at("http://localhost:9601/");

test("hosts that mean the machine itself", () => {
  for (const host of ["localhost", "LOCALHOST", "a.localhost", "127.0.0.1", "127.9.9.9", "[::1]", "0.0.0.0"]) assert.ok(isLocal(host), host);
  for (const host of ["rhino.school", "localhost.school", "192.168.1.7", "127.example", "[fe80::1]", "rhino"]) assert.ok(!isLocal(host), host);
});

test("a name or an address, with the port of the page unless it has one", () => {
  const cases = { "rhino.school": "http://rhino.school:9601", " 192.168.1.7 ": "http://192.168.1.7:9601", "rhino:80": "http://rhino", "fe80::1": "http://[fe80::1]:9601",
    "[fe80::1]:8080": "http://[fe80::1]:8080", "https://robots.school/": "https://robots.school" };
  for (const [typed, origin] of Object.entries(cases)) assert.equal(addressOf(typed, kHere).origin, origin, typed);
});

test("what is no host is refused, and so is the machine itself", () => {
  for (const typed of ["", "  ", "a b", "rhino/cell", "http://", "me@rhino", "rhino?x", "ftp://rhino"]) assert.throws(() => addressOf(typed, kHere), /A name or an address, please/, typed);
  for (const typed of ["localhost", "127.0.0.1", "::1", "http://localhost:80"]) assert.throws(() => addressOf(typed, kHere), /means their own machine/, typed);
});

test("the page’s own host is that of the links, unless it is the machine itself", async () => {
  const links = new StudentLinks({ location: at("http://rhino.school:9601/?a#b") });
  assert.equal(await links.linkOf("7", "a+b"), "http://rhino.school:9601/cell/7#token=a%2Bb");
  assert.deepEqual([links.host, links.isNamed], ["rhino.school", false]);
  assert.equal(new StudentLinks({ location: at("http://[fe80::1]:9601/") }).host, "fe80::1");
  assert.equal(new StudentLinks({ location: kHere }).address, null);
});
