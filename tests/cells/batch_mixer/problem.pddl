; The recipe: 40 l of water and 20 l of syrup, mixed, at 60 degC; and all of it in the product's tank.
(define (problem lemonade)
  (:domain batch-mixer)
  (:objects water syrup - raw m1 - mixer a20 a40 - amount)
  (:init
    (= (store water) 150) (= (store syrup) 80) (= (dosed water) 0) (= (dosed syrup) 0)
    (= (level m1) 2) (= (heel m1) 2) (= (capacity m1) 72)
    (= (temperature m1) 20) (= (cold) 20) (= (lukewarm) 30) (= (hot) 60)
    (= (litres a20) 20) (= (litres a40) 40)
    (= (product) 0) (= (effort) 0))
  (:goal (and (= (dosed water) 40) (= (dosed syrup) 20) (= (product) 60)))
  (:metric minimize (effort)))
