// Archives of files, without compression.
#pragma once

#include <span>
#include <string>

#include "core/bytes.h"

namespace sporeprint::api {

/// A file of an archive.
struct ArchiveFile {
    std::string name;  ///< relative path, '/' between folders, UTF-8
    Body content;
};

/// Returns a ZIP archive whose files are stored as they are and dated 1980-01-01, so that equal
/// files give equal archives. The slices of their contents are shared, not copied: the packaged
/// libraries would copy each file at least once.
///
/// throws  GenerationError for more than 65,535 files, or 4 GB
/// source  APPNOTE.TXT 6.3, sections 4.3.7, 4.3.12 and 4.3.16
[[nodiscard]] Body zip_archive(std::span<const ArchiveFile> files);

}  // namespace sporeprint::api
