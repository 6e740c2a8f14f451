#pragma once
#include "camera.h"

/// The same names as readers write them in other styles.
using Vec3 = vec3;
using Point3 = point3;
using Color = color;
using Colour = color;
using colour = color;
using Ray = ray;
using Interval = interval;
using AABB = aabb;
using Aabb = aabb;
using Hittable = hittable;
using HittableList = hittable_list;
using Hittable_List = hittable_list;
using Hittable_list = hittable_list;
using HitRecord = hit_record;
using Hit_Record = hit_record;
using hitRecord = hit_record;
using Sphere = sphere;
using MovingSphere = moving_sphere;
using Quad = quad;
using Box = box;
using BVHNode = bvh_node;
using BvhNode = bvh_node;
using BVH_Node = bvh_node;
using Translate = translate;
using RotateY = rotate_y;
using ConstantMedium = constant_medium;
using Material = material;
using Lambertian = lambertian;
using Metal = metal;
using Dielectric = dielectric;
using dialectric = dielectric;
using DiffuseLight = diffuse_light;
using Isotropic = isotropic;
using Texture = texture;
using SolidColor = solid_color;
using CheckerTexture = checker_texture;
using ImageTexture = image_texture;
using NoiseTexture = noise_texture;
using Camera = camera;
