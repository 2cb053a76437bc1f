// The control of this folder: it compiles, and differs from the other files only in having no
// error.
#include "core/params/describe.h"

namespace sporeprint {

enum class Shape { bell, funnel };

constexpr const char* name(Shape shape) {
    switch (shape) {
        case Shape::bell:
            return "bell";
        case Shape::funnel:
            return "funnel";
    }
    return nullptr;
}

struct Cap {
    Shape shape = Shape::bell;
    double radius = 0.04;
    double height = 0.02;

    static constexpr void fields(auto visit) {
        visit(&Cap::shape, Info{.name = "shape", .doc = "Outline."});
        visit(&Cap::radius, Info{.name = "radius", .min = 0, .max = 1, .doc = "To the rim."});
        visit(&Cap::height, Info{.name = "height", .min = 0, .max = 1, .doc = "To the apex."});
    }
};
static_assert(well_described<Cap>());

std::vector<Problem> problems_of_cap() { return problems_in(Cap{}); }

}  // namespace sporeprint
