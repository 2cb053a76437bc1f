#include "server/bake/tar_writer.h"

#include <archive.h>
#include <archive_entry.h>

#include <stdexcept>
#include <utility>

namespace sporeprint::server {

namespace {

struct FreeEntry {
    void operator()(archive_entry* entry) const { archive_entry_free(entry); }
};

constexpr int mode = 0644;

}  // namespace

void TarWriter::Free::operator()(archive* one) const { archive_write_free(one); }

std::int64_t TarWriter::write(archive* /*of*/, void* self, const void* data, std::size_t size) {
    TarWriter& writer = *static_cast<TarWriter*>(self);
    // Exceptions must not pass through C.
    if (writer.error_) return -1;
    try {
        writer.sink_(data, size);
        return static_cast<std::int64_t>(size);
    } catch (...) {
        writer.error_ = std::current_exception();
        return -1;
    }
}

TarWriter::TarWriter(Sink sink) : sink_(std::move(sink)), archive_(archive_write_new()) {
    if (!archive_) throw std::bad_alloc();
    check(archive_write_set_format_ustar(archive_.get()), "an archive");
    // Unbuffered, so that the number of bytes written is that of the archive's; the end is not padded to a tape's block.
    check(archive_write_set_bytes_per_block(archive_.get(), 0), "an archive");
    check(archive_write_set_bytes_in_last_block(archive_.get(), 1), "an archive");
    check(archive_write_open(archive_.get(), this, nullptr, &TarWriter::write, nullptr),
          "an archive");
}

TarWriter::~TarWriter() {
    // Freeing would write the end of an archive that is not finished.
    if (!error_) error_ = std::make_exception_ptr(std::logic_error("not finished"));
}

void TarWriter::check(int code, const std::string& what) {
    if (error_) std::rethrow_exception(error_);
    if (code == ARCHIVE_OK) return;
    const char* const why = archive_error_string(archive_.get());
    throw std::runtime_error(what + " cannot be written: " + (why ? why : "an unknown error"));
}

std::uint64_t TarWriter::add(const std::string& name, const Body& body) {
    const std::unique_ptr<archive_entry, FreeEntry> entry(archive_entry_new());
    if (!entry) throw std::bad_alloc();
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<std::int64_t>(size_of(body)));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), mode);
    archive_entry_set_mtime(entry.get(), 0, 0);
    archive_entry_set_uid(entry.get(), 0);
    archive_entry_set_gid(entry.get(), 0);
    check(archive_write_header(archive_.get(), entry.get()), name);
    const auto begin = static_cast<std::uint64_t>(archive_filter_bytes(archive_.get(), -1));
    for (const Slice& slice : body)
        if (slice.size > 0 && archive_write_data(archive_.get(), slice.data(), slice.size) !=
                                  static_cast<std::int64_t>(slice.size))
            check(ARCHIVE_FATAL, name);
    check(archive_write_finish_entry(archive_.get()), name);
    return begin;
}

void TarWriter::finish() { check(archive_write_close(archive_.get()), "an archive"); }

}  // namespace sporeprint::server
