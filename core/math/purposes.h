// The list of all purposes of random draws: each purpose is a stream of its own
// (core/math/random.h), so that a new draw in one place changes nothing elsewhere.
#pragma once

#include <cstdint>

/// The purposes of random streams. Assigned numbers never change: another number makes another
/// individual for every seed.
namespace sporeprint::purposes {

enum Purpose : std::uint32_t {
    variation = 0,    ///< how an individual differs from its species
    axis_angles = 1,  ///< directions of lean and bend
    dents = 2,        ///< small deformations
    margin_waves = 3,
    lobes = 4,   ///< azimuth: fans, lobes, rays
    relief = 5,  ///< folds, pits and tiers
    warts = 11,  ///< places of warts; likewise for the two below
    scales = 12,
    bulb_scales = 13,
    ring_ruffle = 22,
    ring_grooves = 23,
    ring_tear = 24,
    sac = 25,
    corners = 26,       ///< outlines of solid warts, scales and bulb scales
    blade_ripple = 29,  ///< deviation of single gills
    sac_folds = 30,
    bites = 31,
    splits = 32,
    tongues = 33,
    crack_net = 34,
    radial_cracks = 35,
    furrows = 36,
    ragged = 37,  ///< edges of torn or melted parts
    drips = 38,
    damage_spots = 40,        ///< four kinds on four parts
    grown_ramification = 60,  ///< biorders of a tree, sampled node by node
    exact_ramification = 61,  ///< biorders of a tree with exact counts, shuffled
    ramification_tips = 62,   ///< small trees in place of leaves
    tree_axes = 63,           ///< lengths, angles and azimuths of a tree's axes and nodes
    leaf_autumn = 64,         ///< time at which each leaf changes colour
    placed_leaves = 65,       ///< orientation of leaves on their twigs
    leaf_thinning = 66,       ///< order in which leaves are omitted
    spot_spin = 67,           ///< rotation of polygonal spots
    leaf_variation = 68,      ///< how a leaf differs from its preset
    root_field = 70,          ///< vector field that the roots of a colony follow
    root_branches = 71,       ///< places where roots branch
    root_stems = 72,          ///< which nodes of roots bear a stem
    colony_seeds = 73,        ///< the different individuals of a colony
    colony_places = 74,       ///< their places in habits without roots
    colony_postures = 75,     ///< rotation of each instance, and which individual it is
    colony_thinning = 76,     ///< which stems are removed where there are more than requested
    branch_trunks = 77,       ///< the branching of each further trunk
    branch_segments = 78,     ///< how segments differ from their style
    eaten_tips = 79,          ///< which tips slugs have eaten
    segment_turns = 80,       ///< which side of its image a segment turns to the front
    cap_paint = 101,
    hymenium = 102,  ///< places of gills, ridges, pores and spines
    stem_paint = 103,
    veil_paint = 104,
    clouds = 105,         ///< slowly varying fields of paint
    wart_outlines = 106,  ///< painted
    wander = 107,         ///< common deviation of all gills
    blade_paint = 108,
    flesh_paint = 109,
    painted_damage = 110,  ///< painted, ten kinds
    scale_outlines = 120,  ///< painted
    damage_grain = 121,
    skin_grain = 122,      ///< texture of cap and stem
    hue = 123,             ///< the individual's own hue, and its drift across the cap
    zone_widths = 124,     ///< of a zoned cap
    unevenness = 130,      ///< of outlines and stems
    colony_layout = 131,   ///< seed of the layout of a colony
    colony_patches = 132,  ///< middles of the patches of a troop; slope of the rows of a tier
    wood = 133,            ///< bumps of a piece of wood
    root_flare = 134,      ///< places of the roots of a trunk
    peridioles = 135,      ///< how each lies in its cup
    net_cells = 136,       ///< meshes of a receptacle
    net_arms = 137,        ///< how thick each arm of a receptacle is along its middle
    spines = 139,          ///< how each spine hangs
    net_lumps = 138,       ///< how spongy the arms round each mesh are
    bracket_base = 140,    ///< how unevenly a bracket meets its wood
    ground = 141,          ///< soil, litter and strands at a foot
    ground_paint = 144,
    species_damage = 145,   ///< seed of the damage of one species of an individual
    tree_tints = 146,       ///< hue and brightness of each branch of a tree, and of each leaf
    leaf_damage = 147,      ///< where insects have eaten a leaf
    fallen_litter = 148,    ///< litter on a cap
    ground_crumbs = 149,    ///< grains of soil on a clod and beside it
    crossing = 150,         ///< what an offspring has of which parent
    mutation = 151,         ///< how its genes differ from those of its parents
    leaf_spray = 152,       ///< leaves of a twig, and of a branch, on the image of a tree's leaves
    terrain = 200,          ///< place, seed and direction of each octave of a world's heights
    weather = 201,          ///< of a world: rain and warmth, day by day
    patches = 202,          ///< of a wood: seeds of patches and their storms
    seedlings = 203,        ///< candidates for trees, cell by cell
    dead_wood = 204,        ///< how a dead tree falls
    founders = 220,         ///< where and when a species arrives in a world
    mycelium_births = 230,  ///< mycelia in a cell and an epoch, on a host or on a dead trunk
    mycelium_arcs = 231,    ///< the arcs of a ring of fruit bodies, and its radius round a tree
    flushes = 232,          ///< how much good weather a mycelium needs before it fruits
    fruit_places = 233,     ///< numbers and places of the fruit bodies of a flush
    brackets = 234,         ///< places and years of perennial fruit bodies
    floor_pieces = 240,     ///< what is painted on the floor of a world, such as leaves and twigs
    floor_noise = 241,      ///< seeds of the noises of that floor and of its relief
    plot_pieces = 242,      ///< leaves and blades that lie or stand on a plot as meshes
    trunk_ends = 243,       ///< broken ends of dead trunks
    surfels = 250,          ///< places and priorities of the surfels of an uploaded scene
    scene_rays = 251,       ///< directions in which a surfel looks for the sky and the rain
    spore_packets = 252,    ///< ways of spores through an uploaded scene
    scene_mycelia = 253,    ///< mycelia on the surfels of a scene
};

/// Returns how many consecutive numbers a purpose takes, itself the first; 0 if no purpose begins
/// here. The switch lists all of them: the compiler refuses duplicates and omissions.
[[nodiscard]] constexpr std::uint32_t numbers_of(Purpose which) {
    switch (which) {
        case damage_spots:
            return 16;
        case painted_damage:
            return 10;
        case corners:
        case ground:
            return 3;
        case variation:
        case axis_angles:
        case dents:
        case margin_waves:
        case lobes:
        case relief:
        case warts:
        case scales:
        case bulb_scales:
        case ring_ruffle:
        case ring_grooves:
        case ring_tear:
        case sac:
        case blade_ripple:
        case sac_folds:
        case bites:
        case splits:
        case tongues:
        case crack_net:
        case radial_cracks:
        case furrows:
        case ragged:
        case drips:
        case grown_ramification:
        case exact_ramification:
        case ramification_tips:
        case tree_axes:
        case leaf_autumn:
        case placed_leaves:
        case leaf_thinning:
        case spot_spin:
        case leaf_variation:
        case root_field:
        case root_branches:
        case root_stems:
        case colony_seeds:
        case colony_places:
        case colony_postures:
        case colony_thinning:
        case branch_trunks:
        case branch_segments:
        case eaten_tips:
        case segment_turns:
        case cap_paint:
        case hymenium:
        case stem_paint:
        case veil_paint:
        case clouds:
        case wart_outlines:
        case wander:
        case blade_paint:
        case flesh_paint:
        case scale_outlines:
        case damage_grain:
        case skin_grain:
        case hue:
        case zone_widths:
        case unevenness:
        case colony_layout:
        case colony_patches:
        case wood:
        case root_flare:
        case peridioles:
        case net_cells:
        case net_arms:
        case net_lumps:
        case bracket_base:
        case spines:
        case ground_paint:
        case species_damage:
        case tree_tints:
        case leaf_damage:
        case leaf_spray:
        case fallen_litter:
        case ground_crumbs:
        case crossing:
        case mutation:
        case terrain:
        case weather:
        case patches:
        case seedlings:
        case dead_wood:
        case founders:
        case mycelium_births:
        case mycelium_arcs:
        case flushes:
        case fruit_places:
        case brackets:
        case floor_pieces:
        case floor_noise:
        case plot_pieces:
        case trunk_ends:
        case surfels:
        case scene_rays:
        case spore_packets:
        case scene_mycelia:
            return 1;
    }
    return 0;
}

/// Returns true if no number belongs to two purposes below `end`.
[[nodiscard]] constexpr bool are_apart(std::uint32_t end) {
    std::uint32_t free_from = 0;
    for (std::uint32_t number = 0; number < end; ++number) {
        const std::uint32_t numbers = numbers_of(static_cast<Purpose>(number));
        if (numbers == 0) continue;
        if (number < free_from) return false;
        free_from = number + numbers;
    }
    return true;
}
static_assert(are_apart(1000), "two purposes would share their draws");

}  // namespace sporeprint::purposes
