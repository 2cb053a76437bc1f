// The tables of a SQLite file of documents. Each entry brings the schema from the number of those before it to the
// next; entries are only ever appended, so that a file of any age can be opened.
#pragma once

namespace sporeprint::server {

inline constexpr const char* sqlite_migrations[] = {
    R"sql(
CREATE TABLE owner (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  created INTEGER NOT NULL,
  disabled INTEGER,
  documents INTEGER NOT NULL DEFAULT 0,
  max_documents INTEGER NOT NULL DEFAULT 200,
  used_bytes INTEGER NOT NULL DEFAULT 0,
  max_bytes INTEGER NOT NULL DEFAULT 209715200
) STRICT;
CREATE TABLE token (
  id TEXT PRIMARY KEY,
  owner INTEGER NOT NULL REFERENCES owner,
  secret_sha256 BLOB NOT NULL,
  label TEXT NOT NULL,
  scope TEXT NOT NULL CHECK (scope IN ('read', 'write', 'admin')),
  created INTEGER NOT NULL,
  expires INTEGER,
  last_used INTEGER,
  revoked INTEGER
) STRICT;
CREATE INDEX token_owner ON token (owner);
CREATE TABLE blob (
  sha256 BLOB PRIMARY KEY,
  media TEXT NOT NULL,
  size INTEGER NOT NULL,
  refs INTEGER NOT NULL,
  bytes BLOB NOT NULL
) STRICT;
CREATE INDEX blob_unused ON blob (refs) WHERE refs = 0;
CREATE TABLE document (
  id INTEGER PRIMARY KEY,
  owner INTEGER NOT NULL REFERENCES owner,
  name TEXT NOT NULL,
  newest INTEGER NOT NULL DEFAULT 0,
  state TEXT NOT NULL CHECK (state IN ('active', 'unlisted', 'purged')),
  parent TEXT NOT NULL,
  parent2 TEXT NOT NULL,
  created INTEGER NOT NULL,
  updated INTEGER NOT NULL,
  serial INTEGER NOT NULL DEFAULT 0,
  UNIQUE (owner, name)
) STRICT;
CREATE INDEX document_serial ON document (serial);
CREATE INDEX document_parent ON document (parent);
CREATE TABLE version (
  document INTEGER NOT NULL REFERENCES document,
  number INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  hash BLOB NOT NULL,
  format INTEGER NOT NULL,
  kind TEXT NOT NULL,
  title TEXT NOT NULL,
  size INTEGER NOT NULL,
  made INTEGER NOT NULL,
  note TEXT NOT NULL,
  text TEXT NOT NULL,
  PRIMARY KEY (document, number)
) STRICT;
CREATE TABLE version_blob (
  document INTEGER NOT NULL,
  number INTEGER NOT NULL,
  place TEXT NOT NULL,
  sha256 BLOB NOT NULL REFERENCES blob,
  PRIMARY KEY (document, number, place),
  FOREIGN KEY (document, number) REFERENCES version
) STRICT;
CREATE INDEX version_blob_sha256 ON version_blob (sha256);
CREATE TABLE share (
  id TEXT PRIMARY KEY,
  document INTEGER NOT NULL REFERENCES document,
  secret_sha256 BLOB NOT NULL,
  created INTEGER NOT NULL,
  expires INTEGER NOT NULL,
  revoked INTEGER
) STRICT;
CREATE INDEX share_document ON share (document);
CREATE TABLE counter (
  only_row INTEGER PRIMARY KEY CHECK (only_row = 1),
  serial INTEGER NOT NULL
) STRICT;
INSERT INTO counter VALUES (1, 0);
CREATE TRIGGER version_fixed BEFORE UPDATE ON version WHEN OLD.number > 0
BEGIN SELECT RAISE(ABORT, 'a published version never changes'); END;
)sql",
};

}  // namespace sporeprint::server
