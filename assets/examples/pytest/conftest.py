pytest_plugins = ["tyndall.pytest_plugin"]
