#include "core/params/canonical.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

#include "core/params/reader.h"
#include "tests/core/params/arbitrary.h"
#include "tests/core/params/sample.h"

namespace sporeprint::params_canonical_test {
namespace {

using sample::Request;

std::string canonical_of(std::string_view text) {
    std::vector<Problem> problems;
    const Request request = read_json<Request>(text, problems);
    EXPECT_TRUE(problems.empty()) << text;
    return canonical_text(request);
}

TEST(Canonical, DoesNotDependOnTheSpelling) {
    const std::string standard = canonical_of("{}");
    for (const char* same :
         {R"({"seed":1})", R"({"seed":1.0,"cap":{"radius":4e-2}})", R"({"cap":{"radius":0.040}})",
          R"({"cap":{"colour":"#d22b1f","radius":0.04},"seed":1e0})", R"({"wind":[-0.0,-0,0]})",
          R"({"model":{"form":"swept"}})", R"({"image":""})", R"({"age":0.6000})",
          R"({"rough":0.3})"})
        EXPECT_EQ(canonical_of(same), standard) << same;
    for (const char* other :
         {R"({"seed":2})", R"({"tint":"#000000"})", R"({"roots":{"form":"branched"}})",
          R"({"profile":[]})", R"({"image":"Zg=="})", R"({"deformation":{"taper":0}})"})
        EXPECT_NE(canonical_of(other), standard) << other;
}

TEST(Canonical, ContainsEveryValueInFieldOrder) {
    EXPECT_EQ(canonical_text(Request{}),
              "{seed:1,age:0.6,has_ring:false,animation:none,texture_size:1024,rough:0.3,"
              "cap:{radius:0.04,tilt_deg:4,gill_count:90,colour:#D22B1F,},r:0.1,y:0.2,"
              "stem_radius:0.008,deformation:{low:{},high:{},},v:\"\","
              "model:{form:swept,outline:[{r:0.1,y:0,},{r:0.2,y:0.5,},],twist:0,gloss:0.5,},"
              "roots:{form:bare,},ground:{form:bare,},span:[0.25,0.5,],wind:[0,0,0,],"
              "profile:[1,0.9,1.1,],tags:[],}");
}

TEST(Canonical, UploadsAreWrittenAsTheirDigest) {
    Request request;
    request.image = uploaded({'a', 'b', 'c'});
    EXPECT_NE(canonical_text(request).find("image:sha256:ba7816bf8f01cfea"), std::string::npos);
}

TEST(Canonical, EqualTextMeansEqualValues) {
    EXPECT_TRUE(rc::check([] {
        const auto a = arbitrary_of<sample::Model>();
        const auto b = arbitrary_of<sample::Model>();
        RC_ASSERT((canonical_text(a) == canonical_text(b)) == (a == b));
    }));
}

TEST(Canonical, TextIsEscapedSoThatItCannotImitateOtherFields) {
    Request a, b;
    a.tags = {Text<8>("a\",\"b")};
    b.tags = {Text<8>("a"), Text<8>("b")};
    EXPECT_NE(canonical_text(a), canonical_text(b));
}

}  // namespace
}  // namespace sporeprint::params_canonical_test
