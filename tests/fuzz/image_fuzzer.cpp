// Fuzzes uploaded images: decoded to a bounded size, or refused.

#include <cstddef>
#include <cstdint>

#include "core/problems.h"
#include "core/surface/codecs.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const Picture picture = decoded_picture({data, size}, "/surface/cap/image");
        expect(picture.width > 0 && picture.width <= largest_upload_side, "the width is bounded");
        expect(picture.height > 0 && picture.height <= largest_upload_side,
               "the height is bounded");
        expect(picture.rgb.size() == 3 * static_cast<std::size_t>(picture.width) *
                                         static_cast<std::size_t>(picture.height),
               "three bytes a pixel");
    } catch (const InvalidInput&) {
        // refused with a reason, as specified
    }
    return 0;
}
