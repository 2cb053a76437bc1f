// The tables of documents in PostgreSQL, as sqlite_schema.h has those of a SQLite file. Each entry brings the schema
// from the number of those before it to the next; entries are only ever appended, so that a database of any age can
// be opened.
#pragma once

namespace sporeprint::server {

inline constexpr const char* postgres_migrations[] = {
    R"sql(
CREATE TABLE owner (
  id BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  name TEXT COLLATE "C" NOT NULL UNIQUE,
  created BIGINT NOT NULL,
  disabled BIGINT,
  documents BIGINT NOT NULL DEFAULT 0,
  max_documents BIGINT NOT NULL DEFAULT 200,
  used_bytes BIGINT NOT NULL DEFAULT 0,
  max_bytes BIGINT NOT NULL DEFAULT 209715200
);
CREATE TABLE token (
  id TEXT PRIMARY KEY,
  owner BIGINT NOT NULL REFERENCES owner,
  secret_sha256 BYTEA NOT NULL,
  label TEXT NOT NULL,
  scope TEXT NOT NULL CHECK (scope IN ('read', 'write', 'admin')),
  created BIGINT NOT NULL,
  expires BIGINT,
  last_used BIGINT,
  revoked BIGINT
);
CREATE INDEX token_owner ON token (owner);
CREATE TABLE blob (
  sha256 BYTEA PRIMARY KEY,
  media TEXT NOT NULL,
  size BIGINT NOT NULL,
  refs BIGINT NOT NULL,
  bytes BYTEA NOT NULL
);
CREATE INDEX blob_unused ON blob (refs) WHERE refs = 0;
CREATE TABLE document (
  id BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  owner BIGINT NOT NULL REFERENCES owner,
  name TEXT COLLATE "C" NOT NULL,
  newest BIGINT NOT NULL DEFAULT 0,
  state TEXT NOT NULL CHECK (state IN ('active', 'unlisted', 'purged')),
  parent TEXT NOT NULL,
  parent2 TEXT NOT NULL,
  created BIGINT NOT NULL,
  updated BIGINT NOT NULL,
  serial BIGINT NOT NULL DEFAULT 0,
  UNIQUE (owner, name)
);
CREATE INDEX document_serial ON document (serial);
CREATE INDEX document_parent ON document (parent);
CREATE TABLE version (
  document BIGINT NOT NULL REFERENCES document,
  number BIGINT NOT NULL,
  revision BIGINT NOT NULL,
  hash BYTEA NOT NULL,
  format BIGINT NOT NULL,
  kind TEXT NOT NULL,
  title TEXT NOT NULL,
  size BIGINT NOT NULL,
  made BIGINT NOT NULL,
  note TEXT NOT NULL,
  text TEXT NOT NULL,
  PRIMARY KEY (document, number)
);
CREATE TABLE version_blob (
  document BIGINT NOT NULL,
  number BIGINT NOT NULL,
  place TEXT COLLATE "C" NOT NULL,
  sha256 BYTEA NOT NULL REFERENCES blob,
  PRIMARY KEY (document, number, place),
  FOREIGN KEY (document, number) REFERENCES version
);
CREATE INDEX version_blob_sha256 ON version_blob (sha256);
CREATE TABLE share (
  id TEXT PRIMARY KEY,
  document BIGINT NOT NULL REFERENCES document,
  secret_sha256 BYTEA NOT NULL,
  created BIGINT NOT NULL,
  expires BIGINT NOT NULL,
  revoked BIGINT
);
CREATE INDEX share_document ON share (document);
CREATE TABLE counter (
  only_row INTEGER PRIMARY KEY CHECK (only_row = 1),
  serial BIGINT NOT NULL
);
INSERT INTO counter VALUES (1, 0);
CREATE FUNCTION refuse_version() RETURNS trigger LANGUAGE plpgsql AS
$$ BEGIN RAISE EXCEPTION 'a published version never changes'; END $$;
CREATE TRIGGER version_fixed BEFORE UPDATE ON version FOR EACH ROW WHEN (OLD.number > 0)
EXECUTE FUNCTION refuse_version();
)sql",
};

}  // namespace sporeprint::server
