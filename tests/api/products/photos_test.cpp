// POST, GET and DELETE under /v1/photos.
#include <gtest/gtest.h>

#include <string>

#include "core/surface/codecs.h"
#include "core/trace/photo_file.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_photos_test {
namespace {

using namespace test;

class PhotoRoutes : public RequestedService {
  protected:
    Response upload(const Bytes& file, const char* type = "image/png") {
        return ask(post(std::string(file.begin(), file.end()), "/v1/photos", type));
    }
    /// Returns the path of an uploaded picture.
    std::string uploaded(const Bytes& file) { return header(upload(file), "Location"); }
};

/// Returns a picture of 60 x 40 pixels, transparent in its right half if it is cut out.
Bytes picture(bool is_cut_out) {
    Bytes rgba;
    for (int i = 0; i < 60 * 40; ++i)
        rgba.insert(rgba.end(),
                    {200, 40, 30, static_cast<std::uint8_t>(is_cut_out && i % 60 >= 30 ? 0 : 255)});
    return png(rgba, 60, 40);
}

TEST_F(PhotoRoutes, GiveASecretNameAndThePictureBack) {
    const Response response = upload(picture(false));
    ASSERT_EQ(response.status, 201) << text_of(response);
    EXPECT_EQ(header(response, "Cache-Control"), "private, no-store");
    EXPECT_EQ(header(response, "ETag"), "");
    const Value body = json_of(response);
    const std::string name = body.find("photo")->as_string();
    EXPECT_EQ(name.size(), 22U);
    EXPECT_EQ(header(response, "Location"), "/v1/photos/" + name + ".jpg");
    EXPECT_EQ(body.find("width")->as_number(), 60);
    EXPECT_EQ(body.find("height")->as_number(), 40);
    EXPECT_FALSE(body.find("alpha")->as_bool());
    EXPECT_EQ(body.find("expires_s")->as_number(), 1800);

    const Response stored = ask(header(response, "Location"));
    ASSERT_EQ(stored.status, 200);
    EXPECT_EQ(header(stored, "Content-Type"), "image/jpeg");
    EXPECT_EQ(header(stored, "Cache-Control"), "private, no-store");
    EXPECT_FALSE(stored.cacheable);
    const std::string file = text_of(stored);
    const Picture decoded =
        decoded_picture({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "");
    EXPECT_EQ(decoded.width, 60);
    EXPECT_NEAR(decoded.rgb[0], 200, 4);
    EXPECT_NEAR(decoded.rgb[1], 40, 4);
}

TEST_F(PhotoRoutes, TellWhetherAPictureIsCutOut) {
    EXPECT_TRUE(json_of(upload(picture(true))).find("alpha")->as_bool());
}

TEST_F(PhotoRoutes, GiveEqualUploadsDifferentNames) {
    EXPECT_NE(uploaded(picture(false)), uploaded(picture(false)));
}

TEST_F(PhotoRoutes, ForgetAPhotograph) {
    const std::string path = uploaded(picture(false)), other = uploaded(picture(false));
    const Response forgotten = ask(request("DELETE", path));
    EXPECT_EQ(forgotten.status, 204);
    EXPECT_FALSE(forgotten.has_body);
    expect_problem(ask(path), 404);
    expect_problem(ask(request("DELETE", path)), 404);
    EXPECT_EQ(ask(other).status, 200);
    expect_problem(ask("/v1/photos/AAAAAAAAAAAAAAAAAAAAAA.jpg"), 404);
}

TEST_F(PhotoRoutes, StoreNothingButPixels) {
    // A JPEG file with a page behind its end and a comment within.
    Bytes file = jpeg(Bytes(3 * 30 * 30, 90), 30, 30, 90, Chroma::full);
    const std::string comment = "where it was taken", page = "<html><script>alert(1)</script>";
    Bytes segment = {0xFF, 0xFE, 0, static_cast<std::uint8_t>(comment.size() + 2)};
    segment.insert(segment.end(), comment.begin(), comment.end());
    file.insert(file.begin() + 2, segment.begin(), segment.end());
    file.insert(file.end(), page.begin(), page.end());
    const Response response = upload(file, "image/jpeg");
    ASSERT_EQ(response.status, 201) << text_of(response);
    const std::string stored = text_of(ask(header(response, "Location")));
    EXPECT_EQ(stored.find(comment), std::string::npos);
    EXPECT_EQ(stored.find("script"), std::string::npos);
}

TEST_F(PhotoRoutes, SniffTheFormatWhateverItsTypeSays) {
    EXPECT_EQ(upload(picture(false), "image/jpeg").status, 201);
    EXPECT_EQ(upload(picture(false), "IMAGE/WEBP; x=1").status, 201);
    const Response response = upload(picture(false), "application/octet-stream");
    expect_problem(response, 415);
    EXPECT_NE(text_of(response).find("image/jpeg or image/png or image/webp"), std::string::npos);
}

TEST_F(PhotoRoutes, RefuseWhatIsNoPhotograph) {
    const Response gif = upload({'G', 'I', 'F', '8', '9', 'a'});
    expect_problem(gif, 400);
    EXPECT_EQ(json_of(gif).find("detail")->as_string(), "neither a JPEG, a PNG nor a WebP file");
    const Bytes whole = picture(false);
    const Response early = upload({whole.begin(), whole.end() - 20});
    expect_problem(early, 400);
    EXPECT_EQ(json_of(early).find("detail")->as_string(), "the PNG file ends early");
    expect_problem(upload({}), 400);
    expect_problem(ask(post(std::string(most_photo_bytes + 1, 'x'), "/v1/photos", "image/png")),
                   413);
    expect_problem(ask(post("x", "/v1/photos?name=me", "image/png")), 400);
    expect_problem(ask(uploaded(picture(false)) + "?v=1"), 400);
    EXPECT_EQ(most_body(service_, "POST", "/v1/photos"), 12U << 20U);
}

TEST_F(PhotoRoutes, AllowTheirMethodsAlone) {
    const std::string path = uploaded(picture(false));
    const Response put = ask(request("PUT", path));
    expect_problem(put, 405);
    EXPECT_EQ(header(put, "Allow"), "GET, HEAD, DELETE, OPTIONS");
    EXPECT_EQ(header(ask(request("OPTIONS", path)), "Access-Control-Allow-Methods"),
              "GET, HEAD, DELETE, OPTIONS");
    EXPECT_EQ(ask(request("HEAD", path)).status, 200);
}

}  // namespace
}  // namespace sporeprint::api::products_photos_test
