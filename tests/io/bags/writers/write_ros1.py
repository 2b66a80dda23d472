#!/usr/bin/python3
"""write_ros1.py FOLDER: writes the scene of scene.md as ROS 1 bags with Debian's rosbag: plain.bag, bz2.bag, lz4.bag, and
unindexed.bag, which its recorder did not close."""
import math
import os
import struct
import sys
import zlib

import genpy
import rosbag
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

INSTANTS = 12


def png(width, height, pixels):
    def part(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    rows = b"".join(b"\0" + pixels[v * width:(v + 1) * width] for v in range(height))
    return (b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            part(b"IDAT", zlib.compress(rows)) + part(b"IEND", b""))


def gray(k):
    return bytes((3 * u + 7 * v + 5 * k) % 256 for v in range(24) for u in range(32))


def stamped(kind, stamp, frame, seq=0):
    message = kind()
    message.header.stamp, message.header.frame_id, message.header.seq = stamp, frame, seq
    return message


def image(stamp, width, height, encoding, step, data, seq):
    message = stamped(Image, stamp, "cam", seq)
    message.width, message.height, message.encoding, message.step, message.data = width, height, encoding, step, data
    return message


def set_pose(pose, k):
    pose.position.x, pose.position.y, pose.position.z = 0.1 * k, 1, 2
    pose.orientation.z, pose.orientation.w = math.sin(0.05 * k), math.cos(0.05 * k)


def transform(stamp, parent, child, translation, rotation):
    """rotation: x, y, z, w"""
    message = stamped(TransformStamped, stamp, parent)
    message.child_frame_id = child
    t, q = message.transform.translation, message.transform.rotation
    t.x, t.y, t.z = translation
    q.x, q.y, q.z, q.w = rotation
    return message


def write_images(bag, k, stamp, time):
    bag.write("/cam/image_raw", image(stamp, 32, 24, "mono8", 32, gray(k), k), time)
    for half in (0, 50_000_000):
        bag.write("/depth/image", image(stamp, 4, 2, "16UC1", 8, bytes(16), k), time + genpy.Duration(0, half))
    if k >= 6:
        return
    compressed = stamped(CompressedImage, stamp, "cam", k)
    compressed.format, compressed.data = "mono8; png compressed ", png(32, 24, gray(k))
    bag.write("/cam/image_raw/compressed", compressed, time)
    bag.write("/color/image_color", image(stamp, 4, 2, "bgr8", 12, bytes([10 * k, 20 * k, 30 * k] * 8), k), time)


def write_poses(bag, k, stamp, time):
    moved = transform(stamp, "/world", "body", (0.1 * k, 1, 2), (0, 0, math.sin(0.05 * k), math.cos(0.05 * k)))
    bag.write("/vicon/body", moved, time)
    bag.write("/tf", TFMessage([moved]), time)
    odometry = stamped(Odometry, stamp, "world")
    odometry.child_frame_id = "body"
    set_pose(odometry.pose.pose, k)
    bag.write("/odom", odometry, time)
    pose = stamped(PoseStamped, stamp, "world")
    set_pose(pose.pose, k)
    bag.write("/pose", pose, time)
    uncertain = stamped(PoseWithCovarianceStamped, stamp, "world")
    set_pose(uncertain.pose.pose, k)
    bag.write("/pose_cov", uncertain, time)


def write_instant(bag, k):
    stamp = genpy.Time(1600000000 + k // 10, k % 10 * 100_000_000)
    time = stamp + genpy.Duration(0, 5_000_000)
    write_images(bag, k, stamp, time)
    info = stamped(CameraInfo, stamp, "cam", k)
    info.height, info.width, info.distortion_model = 24, 32, "plumb_bob"
    info.D, info.K = [-0.1, 0.01, 0.001, -0.002, 0], [40, 0, 15.5, 0, 41, 11.25, 0, 0, 1]
    info.R, info.P = [1, 0, 0, 0, 1, 0, 0, 0, 1], [39, 0, 15, 0, 0, 38, 11, 0, 0, 0, 1, 0]
    bag.write("/cam/camera_info", info, time)
    write_poses(bag, k, stamp, time)
    bag.write("/chatter", String("instant %d" % k), time)
    if k % 6 == 0:
        static = transform(stamp, "body", "/cam", (0.1, 0.2, 0.3), (-0.5, 0.5, -0.5, 0.5))
        bag.write("/tf_static", TFMessage([static]), time)


def write(path, compression):
    with rosbag.Bag(path, "w", compression=compression, chunk_threshold=4096) as bag:
        for k in range(INSTANTS):
            write_instant(bag, k)


def write_unclosed(path):
    """The index that close() writes stays away: what a killed recorder leaves."""
    bag = rosbag.Bag(path, "w", compression=rosbag.Compression.LZ4, chunk_threshold=4096)
    for k in range(INSTANTS):
        write_instant(bag, k)
    bag._stop_writing_chunk()
    bag.flush()
    with open(path, "rb") as file:
        content = file.read()
    bag.close()
    with open(path, "wb") as file:
        file.write(content)


folder = sys.argv[1]
write(os.path.join(folder, "plain.bag"), rosbag.Compression.NONE)
write(os.path.join(folder, "bz2.bag"), rosbag.Compression.BZ2)
write(os.path.join(folder, "lz4.bag"), rosbag.Compression.LZ4)
write_unclosed(os.path.join(folder, "unindexed.bag"))
