"""Pictures that should go on looking as they do. The first run keeps them in the folder baselines; later runs fail where
a picture differs by more than its noise. TYNDALL_UPDATE=1 pytest keeps them anew."""

import tyndall


def glass_ball():
    scene = tyndall.scene("glass-spheres")
    scene["/image/width"], scene["/image/height"] = 160, 90
    return scene


def test_glass_ball(tyndall_picture):
    tyndall_picture("glass-ball", glass_ball().render(spp=32))


def test_another_seed_is_the_same_picture(tyndall_picture):
    scene = glass_ball()
    scene["/render/seed"] = 9
    tyndall_picture("glass-ball", scene.render(spp=32))
