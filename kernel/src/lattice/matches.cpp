// SPDX-License-Identifier: Apache-2.0
#include "lattice/matches.h"

#include "state/particles.h"

namespace stylet {

void begin_matches(const State& state, const Scratch& scratch, const MatchGroup& group,
                   Matches& matches_out) {
  const float* const u[3] = {state.ux, state.uy, state.uz};
  for (std::uint32_t lane = 0; lane < group.count; ++lane) {
    matches_out.next_member[lane] = group.first_member[lane];
    for (std::uint32_t n = 0; n < 4; ++n) {
      const std::size_t node = group.side[n / 2].node[n % 2][lane];
      for (std::uint32_t c = 0; c < 3; ++c) {
        matches_out.corner_m[c][2 * n][lane] = u[c][node];
        matches_out.corner_m[c][2 * n + 1][lane] = u[c][node + 1];
      }
    }
    const std::uint32_t slot = group.slot[lane];
    matches_out.corner_turn[0][lane] = state.qw[slot];
    matches_out.corner_turn[1][lane] = state.qx[slot];
    matches_out.corner_turn[2][lane] = state.qy[slot];
    matches_out.corner_turn[3][lane] = state.qz[slot];
    const Member& member = scratch.member[group.first_member[lane]];
    const Quat turn = state.shaft[member.particle].support[member.support].turn;
    matches_out.joint_turn[0][lane] = turn.w;
    matches_out.joint_turn[1][lane] = turn.x;
    matches_out.joint_turn[2][lane] = turn.y;
    matches_out.joint_turn[3][lane] = turn.z;
  }
}

void place_members(const Model& model, const State& state, Scratch& scratch) {
  // The part of the needles' motion in this tick.
  const float to_come = static_cast<float>(scratch.head->substeps_to_come) /
                        static_cast<float>(model.head->config.substeps);
  for_each_particle(model, state, [&](std::uint32_t index) {
    const Particle& p = particle_at(state, index);
    scratch.place[index] = (p.position_m - p.slack_m) - to_come * scratch.stretch[index];
  });
}

void take_members(const State& state, const Scratch& scratch, const MatchGroup& group,
                  std::uint32_t n, Matches& matches, MatchMembers& members_out) {
  const Member* const members = scratch.member;
  const Particle* const particles = state.shaft;
  const Vec3* const places = scratch.place;
  for (std::uint32_t lane = 0; lane < group.count; ++lane) {
    members_out.weight_n_per_m[lane] = 0;
    if (n >= group.member_count[lane]) continue;
    const Member& member = members[matches.next_member[lane]];
    matches.next_member[lane] = member.next;
    const Particle& p = particles[member.particle];
    const Support& support = p.support[member.support];
    const Vec3 place = places[member.particle];
    members_out.weight_n_per_m[lane] = p.stiffness_n_per_m * support.weight;
    members_out.place_m[0][lane] = place.x;
    members_out.place_m[1][lane] = place.y;
    members_out.place_m[2][lane] = place.z;
    members_out.offset_m[0][lane] = support.offset_m.x;
    members_out.offset_m[1][lane] = support.offset_m.y;
    members_out.offset_m[2][lane] = support.offset_m.z;
  }
}

void give_goals(State& state, const Scratch& scratch, const MatchGroup& group,
                const Matches& matches) {
  const Member* const members = scratch.member;
  Particle* const particles = state.shaft;
  for (std::uint32_t lane = 0; lane < group.count; ++lane) {
    const Quat turn = {matches.joint_turn[0][lane], matches.joint_turn[1][lane],
                       matches.joint_turn[2][lane], matches.joint_turn[3][lane]};
    const Vec3 centre_m = {matches.centre_m[0][lane], matches.centre_m[1][lane],
                           matches.centre_m[2][lane]};
    Mat3 r;
    for (std::uint32_t i = 0; i < 9; ++i) r.m[i / 3][i % 3] = matches.rotation[i][lane];
    std::uint32_t at = group.first_member[lane];
    for (std::uint32_t n = 0; n < group.member_count[lane]; ++n) {
      const Member& member = members[at];
      Support& support = particles[member.particle].support[member.support];
      support.goal_m = centre_m + r * support.offset_m;
      support.turn = turn;
      at = member.next;
    }
  }
}

namespace {

// Adds voxels from `begin` up to `end` in plane_order, at one side. `force` as below.
void add_side(const Model& model, Scratch& scratch, std::uint32_t begin, std::uint32_t end,
              std::uint32_t side, std::uint32_t first_particle, float* force) {
  const std::size_t axis = model.head->counts.particles_per_plane;
  for (std::uint32_t i = begin; i < end; ++i) {
    const MatchGroup::Side& own = scratch.group[i / kLanes].side[side];
    const std::uint32_t lane = i % kLanes;
    for (std::uint32_t n = 0; n < 2; ++n) {
      float* at = force + (own.node[n][lane] - first_particle);
      for (std::uint32_t c = 0; c < 3; ++c, at += axis) {
        const float near = own.change_n[n][c][lane][0], far = own.change_n[n][c][lane][1];
        at[0] = at[0] + near;
        at[1] = at[1] + far;
      }
    }
  }
}

}  // namespace

void add_changes(const Model& model, Scratch& scratch, std::uint32_t plane, float* force) {
  const std::uint32_t* const first = scratch.plane_first;
  const std::uint32_t particle = model.plane[plane].particle_begin;
  if (plane > 0) add_side(model, scratch, first[plane - 1], first[plane], 1, particle, force);
  if (plane < model.head->counts.planes) {
    add_side(model, scratch, first[plane], first[plane + 1], 0, particle, force);
  }
}

}  // namespace stylet
