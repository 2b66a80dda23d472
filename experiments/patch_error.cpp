// How wrong a matched patch is, against the truth of the rendered room, and for how long it stays wrong.
//
// A landmark is what was seen at one pixel of one picture. Its true place is where the true ray of that pixel
// meets the room; the error of a match is the pixel that was measured minus the pixel where the true camera
// sees the true place.
//
//   build/patch_error SEED [SECONDS] [KEY=VALUE...] > errors.csv
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "incognita/app/assemble.hpp"
#include "incognita/io/camera.hpp"
#include "incognita/world/room.hpp"

using namespace incognita;

namespace {

/// Where a ray from inside the room first meets a wall or a box; `surface` tells which.
struct Hit {
  Eigen::Vector3d at;
  int surface;
};

Hit first_surface(const RoomLayout& room, const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  double nearest = 1e9;
  int surface = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double wall = along[axis] > 0 ? room.inside.max[axis] : room.inside.min[axis];
    const double t = (wall - from[axis]) / along[axis];
    if (t > 0 && t < nearest) nearest = t, surface = axis * 2 + (along[axis] > 0);
  }
  for (std::size_t b = 0; b < room.boxes.size(); ++b) {
    const Box& box = room.boxes[b];
    double enter = 0, leave = 1e9;
    int side = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double a = (box.min[axis] - from[axis]) / along[axis], c = (box.max[axis] - from[axis]) / along[axis];
      if (a > c) std::swap(a, c);
      if (a > enter) enter = a, side = axis;
      leave = std::min(leave, c);
    }
    if (enter < leave && enter > 0 && enter < nearest) nearest = enter, surface = 100 + int(b) * 6 + side;
  }
  return {from + nearest * along, surface};
}

struct Born {
  Hit hit;
  Hit near[4];  // of pixels around: a patch that spans several surfaces
  int frame;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> sets;
  for (int i = 3; i < argc; ++i) sets.push_back(argv[i]);
  const LoadedScenario loaded =
      load_scenario("room", sets,
                    std::vector<Flag>{{"run.seed", argv[1], "argument"},
                                      {"run.duration_s", argc > 2 ? argv[2] : "60", "argument"}});
  Assembly assembly = assemble(loaded);
  const Camera camera = make_camera(loaded.scenario.camera);
  const RoomLayout room = room_layout(loaded.scenario.room, std::strtoull(argv[1], nullptr, 10));
  auto& [clock, world, sensor, estimator, decision, controller] = assembly.boxes;
  Estimate estimate;
  Command command;
  std::map<std::int64_t, Born> born;
  std::printf(
      "frame,id,kind,du,dv,su,sv,ru,rv,age,view_angle,scale,surfaces,corr,outcome,cos,ex,ey,ez,sx,sy,sz,nees,"
      "ts1,ts2,s1,s2,sd1,sd2,pu,pv\n");
  while (const Tick tick = clock->next()) {
    const auto truth = world->move(command, tick);
    const Observation seen = sensor->look(truth, tick);
    estimator.update(estimate, command, seen, tick);
    const Eigen::Vector3d position = truth->camera.head<3>();
    const Eigen::Matrix3d R = rotation_matrix<double>(truth->camera.segment<4>(3));
    Eigen::Vector3d e = Eigen::Vector3d::Zero(), s = Eigen::Vector3d::Zero();
    double nees = 0;
    if (estimate.started) {
      const auto P = estimate.belief.covariance(estimate.camera);
      const CameraState x = estimate.camera_state();
      e = x.head<3>() - position;
      s = P.diagonal().head<3>().cwiseSqrt();
      const Eigen::Vector3d d = e;
      nees = d.dot(P.topLeftCorner<3, 3>().llt().solve(d)) / 3;
    }
    for (Landmark& l : estimate.catalogue) {
      if (born.count(l.id)) continue;
      Born b;
      b.frame = int(tick.frame);
      const Eigen::Vector2d pixel = l.view.pixel;
      b.hit = first_surface(room, position, R * *camera.unproject(pixel));
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d at = pixel + 5 * Eigen::Vector2d(k & 1 ? 1 : -1, k & 2 ? 1 : -1);
        b.near[k] = first_surface(room, position, R * *camera.unproject(at));
      }
      if (l.kind == Landmark::Kind::anchor) b.hit.at = l.anchor;
      if (std::getenv("ORACLE") && l.kind != Landmark::Kind::anchor) {
        const int axis = b.hit.surface >= 100 ? (b.hit.surface - 100) % 6 : b.hit.surface / 2;
        Eigen::Vector3d n = Eigen::Vector3d::Unit(axis);
        if (n.dot(l.view.plane.facing) < 0) n = -n;
        l.view.plane.facing = n;
        l.view.plane.slope_cov.setZero();
      }
      born[l.id] = b;
    }
    for (const Look& look : estimate.looks) {
      if (!look.measured) continue;
      const Landmark* l = nullptr;
      for (const Landmark& k : estimate.catalogue)
        if (k.id == look.id) l = &k;
      if (!l) continue;
      const Born& b = born.at(look.id);
      if (b.frame == tick.frame) continue;
      const Eigen::Vector3d in_camera = R.transpose() * (b.hit.at - position);
      const auto at = camera.project(in_camera);
      if (!at) continue;
      const Eigen::Vector2d d = *look.measured - at->pixel;
      const Eigen::Vector2d r = *look.measured - look.predicted;
      const Eigen::Vector3d now = b.hit.at - position, then = b.hit.at - l->view.camera_position;
      int others = 0;
      for (const Hit& h : b.near) others += h.surface != b.hit.surface;
      const int axis = b.hit.surface >= 100 ? (b.hit.surface - 100) % 6 : b.hit.surface / 2;
      Eigen::Vector3d tn = Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d fc = l->view.plane.facing, ac = fc.unitOrthogonal();
      tn /= tn.dot(fc);
      const double ts[2] = {tn.dot(ac), tn.dot(fc.cross(ac))};
      std::printf(
          "%d,%ld,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%d,%.4f,%.4f,%d,%.4f,%d,%.3f,%.4f,%.4f,%.4f,%.4f,%.4f,%."
          "4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n",
          int(tick.frame), long(look.id), int(look.kind), d.x(), d.y(), std::sqrt(look.innovation_cov(0, 0)),
          std::sqrt(look.innovation_cov(1, 1)), r.x(), r.y(), int(tick.frame) - b.frame,
          std::acos(std::min(1.0, now.normalized().dot(then.normalized()))), then.norm() / now.norm(), others,
          look.correlation, int(look.outcome), std::abs(then.normalized()[axis]), e.x(), e.y(), e.z(), s.x(),
          s.y(), s.z(), nees, ts[0], ts[1], l->view.plane.slope[0], l->view.plane.slope[1],
          std::sqrt(l->view.plane.slope_cov(0, 0)), std::sqrt(l->view.plane.slope_cov(1, 1)),
          std::sqrt(look.plane_cov(0, 0)), std::sqrt(look.plane_cov(1, 1)));
    }
    const Goal goal = decision.choose(estimate, tick);
    command = controller.act(estimate, goal, tick);
  }
}
