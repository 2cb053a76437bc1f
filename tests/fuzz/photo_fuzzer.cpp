// Fuzzes uploaded photographs: decoded to a bounded size, upright, or refused.

#include <cstddef>
#include <cstdint>

#include "core/problems.h"
#include "core/trace/photo_file.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int orientation = orientation_of({data, size});
    expect(orientation >= 1 && orientation <= 8, "an orientation is one of eight");
    // Large pictures take seconds with the sanitizers; their bounds are tested elsewhere.
    const std::uint64_t pixels = declared_pixels({data, size});
    if (pixels == 0 || pixels > 1'000'000) return 0;
    try {
        const trace::PhotoFile photo = trace::decoded_photo({data, size}, "/photo");
        const Picture& picture = photo.picture;
        expect(picture.width > 0 && picture.width <= trace::decoded_side, "the width is bounded");
        expect(picture.height > 0 && picture.height <= trace::decoded_side,
               "the height is bounded");
        expect(picture.rgb.size() == 3 * static_cast<std::size_t>(picture.width) *
                                         static_cast<std::size_t>(picture.height),
               "three bytes a pixel");
        if (photo.cut_out)
            expect(photo.cut_out->width == picture.width && photo.cut_out->height == picture.height,
                   "the mask has the size of the picture");
    } catch (const InvalidInput&) {
        // refused with a reason, as specified
    }
    return 0;
}
