#include "core/grow/species_from_photo.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <variant>

#include "core/individual/mushroom_spec.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "core/silhouette/outline.h"
#include "core/trace/cut.h"
#include "core/trace/edge.h"
#include "core/trace/likeness.h"
#include "core/trace/photo_colours.h"
#include "core/trace/photo_images.h"
#include "core/trace/soil.h"

namespace sporeprint {

namespace {

/// Species that are named beside the chosen one.
constexpr std::size_t most_named = 5;

/// A mushroom whose sides differ by more of its height was not seen from the side, or is not round; most have
/// a hundredth.
constexpr double most_asymmetry = 0.03;

/// Calls `steps` and reports what they refuse as a request does that can not be met, with paths as in a
/// TraceSpec.
///
/// view  that is looked at, as its path
template <class Steps>
auto with_paths_of_spec(Steps steps, const std::string& view = "/views/side") {
    try {
        return steps();
    } catch (const InvalidInput& refused) {
        std::vector<Problem> problems = refused.problems();
        for (Problem& problem : problems) {
            const std::string_view path = problem.path;
            if (path.starts_with("/gesture") || path.starts_with("/photo"))
                problem.path.insert(0, view);
            else if (path.starts_with("/silhouette") || path.starts_with("/model"))
                problem = {"/views/side",
                           "what is on these lines cannot be grown, because its outline crosses "
                           "itself or the axis; draw them anew, or choose another form"};
        }
        throw Impossible(std::move(problems));
    }
}

trace::Gesture drawn_gesture(const trace::TraceSpec& spec) {
    const auto& gesture = spec.views.side.gesture;
    return gesture ? trace::gesture_of(*gesture) : trace::Gesture{};
}

void require_axis_alone(const trace::Gesture& gesture) {
    std::vector<Problem> problems;
    const auto refuse = [&](bool is_given, const char* stroke) {
        if (is_given)
            report(problems, std::string("/gesture/") + stroke,
                   "is for photographs; this picture is cut out already");
    };
    refuse(!gesture.cap.empty(), "cap");
    refuse(!gesture.keep.empty(), "keep");
    refuse(!gesture.drop.empty(), "drop");
    refuse(gesture.frame.has_value(), "frame");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

/// Returns a picture that is cut out as a mask in one part, the one that the gesture crosses or the largest.
trace::Mask cleaned(const trace::Mask& cut_out, const trace::Gesture& gesture,
                    const Picture& large) {
    trace::Mask mask = trace::resized(cut_out, large.width, large.height);
    if (!gesture.axis.empty())
        mask = trace::connected_with(mask,
                                     trace::drawn({gesture.axis}, large.width, large.height, 3.0));
    mask = trace::without_holes(trace::largest_part(mask));
    if (mask.area() == 0)
        throw InvalidInput("/gesture/axis",
                           "nothing hangs together on this line; draw it through the middle of the "
                           "mushroom, from end to end");
    return mask;
}

/// Returns what a gesture cuts out of a photograph.
///
/// cut_out  as of mushroom_on()
/// copy     its large working copy
/// size     of the photograph
trace::Mask cut_out_by(const trace::Gesture& gesture, const std::optional<trace::Mask>& cut_out,
                       const Picture& copy, const trace::PictureSize& size) {
    const trace::Gesture on_copy = gesture.scaled(static_cast<double>(copy.width) / size.width);
    if (cut_out) {
        require_axis_alone(gesture);
        return cleaned(*cut_out, on_copy, copy);
    }
    trace::require_on(size, gesture);
    return trace::cut_out_of_copy(copy, on_copy);
}

/// Requires that all points of an outline are on a photograph.
void require_on(const trace::PictureSize& photo, const trace::MarkedOutline& outline) {
    constexpr double slack = 2.0;  // working copies are of whole pixels
    std::vector<Problem> problems;
    const auto require_points = [&](std::span<const glm::dvec2> points, const std::string& path) {
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i].x > photo.width + slack || points[i].y > photo.height + slack)
                report(problems, path + "/" + std::to_string(i),
                       "is not on the photograph of " + std::to_string(photo.width) + " x " +
                           std::to_string(photo.height) + " pixels");
    };
    require_points(outline.left, "/outline/left");
    require_points(outline.right, "/outline/right");
    require_points(outline.axis, "/outline/axis");
    require_points(outline.junctions, "/marks/junctions");
    require_points(outline.margins, "/marks/margins");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

/// Returns the given outline of a specification on a working copy.
trace::MarkedOutline outline_on_copy(const trace::TraceSpec& spec, double factor) {
    return trace::rounded(trace::scaled(*trace::marked_outline_of(spec), factor));
}

/// What was found on a mask or given, and its trace; none if it cannot be grown as it was found.
struct Trace {
    trace::FoundOutline found;
    std::optional<trace::Traced> traced;
};

Trace tried(trace::FoundOutline found, const trace::TraceParams& params) {
    try {
        trace::Traced traced = trace::traced(found, params);
        return {std::move(found), std::move(traced)};
    } catch (const Impossible&) {
        return {std::move(found), std::nullopt};
    }
}

/// Traces what is on a mask: by the stated form or the one that fits the outline, or if that cannot be grown by the
/// first that can.
Trace traced_by_any_form(const trace::Mask& mask, const trace::Gesture& gesture,
                         const trace::TraceParams& params) {
    Trace first = tried(trace::outline_on(mask, gesture, params.form), params);
    if (first.traced || params.form != trace::Form::automatic) return first;
    using trace::Form;
    for (const Form form :
         {Form::cup, Form::puffball, Form::funnel, Form::capped, Form::club, Form::morel}) {
        try {
            Trace other = tried(trace::outline_on(mask, gesture, form), params);
            if (other.traced) return other;
        } catch (const InvalidInput&) {
            continue;
        }
    }
    return first;
}

/// Returns a trace of another height.
trace::Traced resized(trace::Traced traced, double factor) {
    Silhouette& silhouette = traced.shape.silhouette;
    for (auto* part : {&silhouette.stem, &silhouette.hymenium, &silhouette.cap})
        for (OutlinePoint& point : *part) point = {point.r * factor, point.y * factor};
    if (traced.ring) traced.ring = {traced.ring->height_m * factor, traced.ring->width_m * factor};
    return traced;
}

/// Returns the species that lends what the photograph does not show, and the age of the mushroom as it would
/// be one of these: the nearest that is traced by the same form, or else one with the same parts.
NearSpecies chosen_template(const trace::Form form, const Atlas& atlas,
                            const std::vector<NearSpecies>& sorted) {
    const auto first = [&](bool is_alike) {
        return std::find_if(sorted.begin(), sorted.end(), [&](const NearSpecies& one) {
            const Species& species = atlas.find(one.id)->species;
            return trace::can_be_template(species, trace::has_face(form)) &&
                   (!is_alike || trace::form_of(species.facts.form) == form);
        });
    };
    auto found = first(true);
    if (found == sorted.end()) found = first(false);
    if (found == sorted.end())
        throw InvalidInput(
            "/template", std::string("no species has the parts of the form ") + trace::name(form));
    return *found;
}

/// Returns the template that a request names, and the age of the mushroom as it would be one of these.
///
/// sorted  of all species that the atlas lists
NearSpecies named_template(std::string_view id, const std::vector<NearSpecies>& sorted,
                           const trace::Likeness& likeness, const Atlas& atlas) {
    const AtlasEntry* const entry = atlas.find(id);
    if (!entry) throw InvalidInput("/template", "there is no species " + in_quotes(id));
    const std::string own = entry->species.id.string();
    const auto found = std::find_if(sorted.begin(), sorted.end(),
                                    [&](const NearSpecies& one) { return one.id == own; });
    return found != sorted.end() ? *found : near_species(likeness, own, atlas);
}

/// A trace and the species that has its shape.
struct Grown {
    trace::Traced traced;
    trace::WholeSpecies whole;
};

/// Returns the template with the heights and widths of what was found, as far as it grows with them at all ages.
Grown stretched(const trace::FoundOutline& found, const trace::TraceParams& params,
                const Species& lender, double age) {
    trace::require_template(lender, trace::has_face(found.form));
    const auto stretched_by = [&](double share) {
        return trace::stretched(found, params, trace::silhouette_at(lender, age), share);
    };
    for (double share = 1.0; share > 0.2; share *= 0.5) {
        trace::Traced traced = stretched_by(share);
        trace::WholeSpecies whole = trace::whole_species(lender, traced.shape, age);
        if (whole.certificate.simple) return {std::move(traced), std::move(whole)};
    }
    Grown last{stretched_by(0.0), {}};
    last.whole = trace::sized_species(lender, last.traced.shape.axis, params.height_m, age);
    last.traced.shape.silhouette =
        std::get<Swept>(last.whole.species.stages[last.whole.stage].model.shape).silhouette;
    return last;
}

/// What photographs from above and below show.
struct FacesShown {
    std::optional<trace::FaceShown> above, below;
};

FacesShown shown_by(const FacesOnPhotos& faces, const trace::Traced& traced) {
    FacesShown shown;
    if (!faces.above && !faces.below) return shown;
    if (faces.below && traced.shape.silhouette.hymenium.empty())
        throw InvalidInput("/views/below", std::string("a ") + trace::name(traced.form) +
                                               " has no lower face; leave this photograph out");
    const Outline outline = Outline::unproven(traced.shape.silhouette, "/silhouette");
    if (faces.above) shown.above = trace::face_shown(*faces.above, outline, trace::Face::upper);
    if (faces.below) shown.below = trace::face_shown(*faces.below, outline, trace::Face::lower);
    return shown;
}

/// Gives each part the colours of the photograph that shows it best.
void take_colours(trace::PartColours& colours, const FacesShown& shown) {
    if (shown.above) {
        std::array<glm::dvec3, trace::PartColours::places> cap{};
        static_assert(trace::PartColours::places == trace::FaceShown::places);
        const auto& quarters = shown.above->quarters;
        for (std::size_t k = 0; k < cap.size(); ++k) cap[k] = quarters[k].value_or(glm::dvec3(0.0));
        if (std::all_of(quarters.begin(), quarters.end(),
                        [](const auto& quarter) { return quarter.has_value(); }))
            colours.cap = cap;
    }
    if (!shown.below) return;
    // Near the stem the face is in its shade, and near the margin there is some of the background.
    for (const std::size_t k : {std::size_t{2}, std::size_t{1}, std::size_t{3}, std::size_t{0}})
        if (shown.below->quarters[k]) {
            colours.face = shown.below->quarters[k];
            return;
        }
}

/// Gives the photographed stage images, and a warning for each part that has none.
void give_images(SpeciesFromPhoto& found, const trace::PhotoImages& images,
                 const FacesShown& shown) {
    constexpr int quality = 88;
    const auto give = [&](Upload& image, const std::optional<Picture>& picture, const char* part) {
        if (picture)
            image = uploaded(
                jpeg(picture->rgb, picture->width, picture->height, quality, Chroma::full));
        else
            found.warnings.push_back(
                {"images", std::string("The photograph shows too little of the ") + part +
                               ", which is painted instead."});
    };
    Surface& surface = found.whole.species.stages[found.whole.stage].model.surface;
    if (!shown.above)
        give(surface.cap.image, images.cap, "cap");
    else if (shown.above->image)
        give(surface.cap.image, shown.above->image, "cap");
    give(surface.stem.image, images.stem, "stem");
    if (shown.below && shown.below->image)
        give(surface.hymenium.image, shown.below->image, "lower face");
}

/// Adds a warning for each face of which a photograph gives neither colours nor an image.
void warn_of_faces(SpeciesFromPhoto& found, const FacesShown& shown) {
    const auto warn = [&](const std::optional<trace::FaceShown>& face, const char* view,
                          const char* part, const char* help) {
        if (!face || face->image) return;
        found.warnings.push_back(
            {"images", face->is_round
                           ? std::string("The photograph from ") + view +
                                 " shows too little of the " + part + ", so it is not used."
                           : std::string("What is cut out of the photograph from ") + view +
                                 " is not as round as a cap, so it is not used" + help + "."});
    };
    warn(shown.above, "above", "cap", "");
    warn(shown.below, "below", "lower face", "; a stem that is seen needs its end, stem_end");
}

/// Says that a species is of a photograph: it is not the template, and has none of its names.
void describe(Facts& facts, const std::string& template_id) {
    facts.scientific_name = Text<64>();
    facts.common_name = Text<64>("Photographed mushroom");
    const std::string note =
        "Traced from a photograph; what it does not show is that of " + template_id;
    facts.sources.insert(facts.sources.begin(), Text<160>(std::string_view(note)));
    facts.sources.resize(std::min(facts.sources.size(), info_of<Facts>("sources").most));
}

std::vector<TraceWarning> warnings_of(const SpeciesFromPhoto& found) {
    std::vector<TraceWarning> warnings;
    const auto percent = [](double share) {
        return number_text(static_cast<double>(static_cast<int>(share * 1000.0 + 0.5)) / 10.0) +
               " %";
    };
    if (found.traced.asymmetry > most_asymmetry)
        warnings.push_back({"asymmetry", "Its left and right side differ by " +
                                             percent(found.traced.asymmetry) +
                                             " of its height; the species has their mean."});
    if (found.traced.method == trace::TraceMethod::straightened)
        warnings.push_back({"method",
                            "Its stem would fold where its line on the photograph bends most, so "
                            "the species has a straighter one."});
    if (found.traced.method == trace::TraceMethod::simplified)
        warnings.push_back({"method",
                            "Its outline would cross itself as it is on the photograph, so "
                            "the species has a plain stem."});
    if (found.traced.method == trace::TraceMethod::stretched)
        warnings.push_back({"method",
                            "Its outline cannot be grown as it is on the photograph, so the "
                            "species has that of its template, stretched to the same heights and "
                            "widths."});
    if (found.whole.likeness < 1.0)
        warnings.push_back({"likeness", "Its other ages have " + percent(found.whole.likeness) +
                                            " of its proportions, or their outlines would cross "
                                            "themselves on the way."});
    return warnings;
}

}  // namespace

MushroomOnPhoto mushroom_on(const Picture& photo, const std::optional<trace::Mask>& cut_out,
                            const trace::TraceSpec& spec) {
    const trace::PictureSize size{photo.width, photo.height};
    Picture copy = trace::reduced(photo, trace::large_side);
    if (spec.outline) return outlined_on(std::move(copy), size, spec);
    return with_paths_of_spec([&] {
        trace::Mask mask = cut_out_by(drawn_gesture(spec), cut_out, copy, size);
        const double factor = static_cast<double>(copy.width) / size.width;
        return MushroomOnPhoto{std::move(copy), std::move(mask), factor};
    });
}

MushroomOnPhoto outlined_on(Picture copy, const trace::PictureSize& size,
                            const trace::TraceSpec& spec) {
    return with_paths_of_spec([&] {
        const trace::MarkedOutline given = *trace::marked_outline_of(spec);
        require_on(size, given);
        trace::require_measurable(given, spec.form);
        const double factor = static_cast<double>(copy.width) / size.width;
        const trace::MarkedOutline outline = outline_on_copy(spec, factor);
        trace::Contour contour = outline.left;
        contour.insert(contour.end(), outline.right.rbegin(), outline.right.rend());
        trace::Mask mask = trace::inside_of(contour, {copy.width, copy.height});
        return MushroomOnPhoto{std::move(copy), std::move(mask), factor};
    });
}

trace::FaceView face_on(const Picture& photo, const std::optional<trace::Mask>& cut_out,
                        const trace::FaceViewSpec& spec, const std::string& path) {
    const trace::PictureSize size{photo.width, photo.height};
    Picture copy = trace::reduced(photo, trace::large_side);
    trace::Mask mask = with_paths_of_spec(
        [&] {
            const trace::Gesture gesture =
                spec.gesture ? trace::gesture_of(*spec.gesture) : trace::Gesture{};
            return cut_out_by(gesture, cut_out, copy, size);
        },
        path);
    return face_on_copy(std::move(copy), std::move(mask), size, spec, path);
}

trace::FaceView face_on_copy(Picture copy, trace::Mask mask, const trace::PictureSize& size,
                             const trace::FaceViewSpec& spec, const std::string& path) {
    std::vector<Problem> problems;
    const double factor = static_cast<double>(copy.width) / size.width;
    const auto on_copy = [&](const std::optional<trace::PhotoPoint>& point, const char* name) {
        if (!point) return std::optional<glm::dvec2>();
        const glm::dvec2 place = trace::place_of(*point);
        if (place.x > size.width || place.y > size.height)
            report(problems, path + "/" + name,
                   "is not on the photograph of " + std::to_string(size.width) + " x " +
                       std::to_string(size.height) + " pixels");
        return std::optional(factor * place);
    };
    const std::optional<glm::dvec2> centre = on_copy(spec.centre, "centre"),
                                    stem_end = on_copy(spec.stem_end, "stem_end");
    if (!problems.empty()) throw Impossible(std::move(problems));
    return {std::move(copy), std::move(mask), centre, stem_end};
}

SpeciesFromPhoto species_from_photo(const MushroomOnPhoto& on, const FacesOnPhotos& faces,
                                    const trace::TraceSpec& spec, const Atlas& atlas,
                                    const NearestSpecies& nearest) {
    return with_paths_of_spec([&] {
        trace::Gesture gesture = drawn_gesture(spec).scaled(on.factor);
        if (gesture.axis.empty()) gesture.axis = trace::upright_line(on.mask);
        const bool was_reversed =
            gesture.axis.size() > 1 && !spec.outline && trace::is_reversed(gesture.axis, on.mask);
        if (was_reversed) std::reverse(gesture.axis.begin(), gesture.axis.end());
        // An outline is what a person has said.
        const trace::Mask mask =
            spec.outline ? on.mask : trace::without_soil(on.picture, on.mask, gesture.axis);
        const bool had_soil = mask.area() < on.mask.area();
        SpeciesFromPhoto found;
        const trace::Likeness likeness = trace::likeness_of(on.picture, mask);
        found.nearest = nearest.find(likeness, atlas.entries().size());
        // Without a template, the form decides what can be one; otherwise the template has one.
        const bool is_any = spec.template_id.view() == "auto";
        std::optional<Trace> first;
        if (spec.outline)
            first = tried({outline_on_copy(spec, on.factor), spec.form}, {});
        else if (is_any)
            first = traced_by_any_form(mask, gesture, {.form = spec.form});
        const NearSpecies chosen =
            is_any ? chosen_template(first->found.form, atlas, found.nearest)
                   : named_template(spec.template_id, found.nearest, likeness, atlas);
        found.template_id = chosen.id;
        found.nearest.resize(std::min(found.nearest.size(), most_named));
        const Species& lender = atlas.find(chosen.id)->species;
        trace::TraceParams params = trace::params_like(lender, chosen.age, 0.1);
        if (spec.form != trace::Form::automatic) params.form = spec.form;
        if (!first) first = Trace{trace::outline_on(mask, gesture, params.form), std::nullopt};
        const trace::Form form = first->found.form;
        if (spec.hollow) params.hollow = *spec.hollow;
        const bool has_height = trace::can_be_template(lender, trace::has_face(form));
        params.height_m = spec.height_m.value_or(has_height ? trace::height_at(lender, chosen.age)
                                                            : params.height_m);
        // Only the depth of a hollow depends on the template.
        std::optional<trace::Traced> as_found =
            first->traced && !trace::is_hollow(form)
                ? resized(*first->traced, params.height_m / trace::TraceParams{}.height_m)
                : tried(first->found, params).traced;
        std::optional<Grown> with_outline;
        if (as_found)
            with_outline =
                Grown{*as_found, trace::whole_species(lender, as_found->shape, chosen.age)};
        // An outline that is simple by itself may still cross itself on the way to other ages.
        Grown grown = with_outline && with_outline->whole.certificate.simple
                          ? *std::move(with_outline)
                          : stretched(first->found, params, lender, chosen.age);
        trace::Traced& traced = grown.traced;
        found.whole = std::move(grown.whole);
        const FacesShown shown = shown_by(faces, traced);
        trace::PartColours colours = trace::part_colours(on.picture, mask, traced);
        take_colours(colours, shown);
        trace::give_colours(found.whole.species, found.whole.stage, colours);
        found.whole.species.id = spec.id;
        describe(found.whole.species.facts, chosen.id);
        // What nobody has stated an age for grows as it was photographed.
        trace::move_ages(found.whole.species, found.whole.stage, MushroomParams{}.age);
        std::optional<trace::PhotoImages> images;
        if (spec.images) images = trace::photo_images(on.picture, mask, traced, params.height_m);
        found.traced = trace::on_copy(std::move(traced), 1.0 / on.factor);
        found.warnings = warnings_of(found);
        if (was_reversed)
            found.warnings.push_back({"reversed",
                                      "The line leads from the top of the mushroom to its foot; "
                                      "it was taken the other way round."});
        if (!spec.outline && trace::edge_of(on.picture, on.mask) < trace::least_edge)
            found.warnings.push_back({"edge",
                                      "There is hardly an edge along this outline; look whether it "
                                      "is that of a mushroom."});
        if (had_soil)
            found.warnings.push_back(
                {"soil",
                 "What the mushroom stands on was cut out with it, and is left "
                 "out."});
        if (images) give_images(found, *images, shown);
        warn_of_faces(found, shown);
        return found;
    });
}

}  // namespace sporeprint
