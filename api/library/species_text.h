// A species as the library stores it: canonical text, with its images beside it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "api/library/records.h"
#include "core/model/species.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The format of the text that this program writes. It reads this and all earlier ones.
/// Since 2 species have an ecology.
inline constexpr int species_format = 2;

/// Returns a species as it is stored: JSON in the order of the schema, images replaced by
/// {"sha256":"<hex>"} and stored as blobs whose places are JSON pointers.
[[nodiscard]] Content content_of(const Species& species);

/// Returns the JSON of a stored species, its images in base64.
///
/// throws  GenerationError if the text is not JSON, which would be an error of the database
[[nodiscard]] Value json_of(const Content& content);

/// Returns a stored species.
///
/// throws  GenerationError if this program cannot read it
[[nodiscard]] Species species_of(const Content& content);

/// Reports texts of a species that have control characters, or characters that change the direction of what
/// follows: whoever lists the names of others would be deceived by them.
void refuse_deceptive_texts(const Value& species, const std::string& path,
                            std::vector<Problem>& problems);

/// Returns a text in Unicode's composed normal form (NFC), so that a name looks and is the same on whatever keyboard
/// it was typed.
///
/// text  valid UTF-8
[[nodiscard]] std::string composed(std::string_view text);

/// Brings all texts of a species into that form.
void compose_texts(Value& species);

/// Returns JSON pointers of the parts in which two species differ, at most `most`.
[[nodiscard]] std::vector<std::string> differences(const Value& a, const Value& b,
                                                   std::size_t most);

}  // namespace sporeprint::api
