incognita_module(models FOLDERS models models/motion models/sensors USES incognita::math)
